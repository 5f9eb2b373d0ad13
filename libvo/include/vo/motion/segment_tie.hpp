#pragma once

#include "vo/base/frame_range.hpp"
#include "vo/motion/learned_relation.hpp"
#include "vo/motion/motion_evidence.hpp"
#include "vo/visual_odometry/ground_height.hpp"

#include <optional>
#include <span>
#include <vector>

namespace vo {

/// The factor that brings one segment of a track to the unit of what is tied before it, and the standard
/// deviation of its logarithm.
struct SegmentTie {
  double scale = 1;
  double sigma = 0;
};

/// Settings of the functions below.
struct SegmentTieOptions {
  double speed_s = 1;              ///< seconds that speed is taken over, either side of the loss
  double usual_speed_sigma = 0.3;  ///< of its logarithm's change, where what is tied is too short to tell
  double relation_window_s = 20;   ///< seconds that alignment error is read over, either side of the loss
  /// Of the logarithm of what it reads: 0.6 of the way from one scene of a drive to the next, and a turn
  /// seems as fast as a straight. Where nothing was lost nothing of this shows, so it is not measured.
  double relation_sigma = 0.5;
  LearnedRelationOptions relation;
};

/// By continuity: something as heavy as a walker or a car has nearly the speed after a short loss that it had
/// before. sigma is how much speed varies over that time elsewhere in what is tied. None if the segment or
/// what is before it stands, or nothing is tied.
///
/// Here and below: `run`, the frames of the segment; `way`, its displacements in its own unit; `tied`, those
/// before it in the common one; one of each per frame. O(frames).
std::optional<SegmentTie> tie_by_speed(std::span<const double> time_s, FrameRange run,
                                       std::span<const std::optional<double>> way,
                                       std::span<const std::optional<double>> tied,
                                       const SegmentTieOptions& options = {});

/// By the relation of alignment error and displacement, learned before the loss and read after it (SSS 3.5).
/// sigma is `relation_sigma`. None without errors, or if there is nothing to be learned.
/// O(window * separations).
std::optional<SegmentTie> tie_by_relation(const MotionEvidence& evidence, FrameRange run,
                                          std::span<const std::optional<double>> way,
                                          std::span<const std::optional<double>> tied,
                                          const SegmentTieOptions& options = {});

/// Both together, each weighted by its inverse variance; the other where one says nothing.
std::optional<SegmentTie> combined(const std::optional<SegmentTie>& a, const std::optional<SegmentTie>& b);

}  // namespace vo
