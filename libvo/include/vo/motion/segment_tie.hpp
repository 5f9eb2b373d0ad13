#pragma once

#include "vo/base/frame_range.hpp"
#include "vo/motion/learned_relation.hpp"
#include "vo/motion/motion_evidence.hpp"
#include "vo/visual_odometry/ground_height.hpp"

#include <optional>
#include <span>
#include <vector>

namespace vo {

/// The factor that converts one segment of a track to the unit of the tied segments before it, and the
/// standard deviation of its logarithm.
struct SegmentTie {
  double scale = 1;
  double sigma = 0;
};

/// Settings of the functions below.
struct SegmentTieOptions {
  double speed_s = 1;              ///< seconds over which speed is averaged, on either side of the loss
  double usual_speed_sigma = 0.3;  ///< of its logarithm's change, where the tied part is too short to show it
  double relation_window_s = 20;   ///< seconds over which alignment error is read, on either side of the loss
  /// Of the logarithm of the displacement read: 0.6 from one scene of a drive to the next, and a turn seems
  /// as fast as a straight. It is fixed because it cannot be measured where nothing was lost.
  double relation_sigma = 0.5;
  LearnedRelationOptions relation;
};

/// By continuity: a walker or a car has too much mass to change its speed much in a short loss. sigma is how
/// much speed varies over that time elsewhere in the tied part. None if the camera is still in the segment or
/// before it, or nothing is tied.
///
/// Here and below: `run`, the frames of the segment; `moved`, its displacements in its own unit; `tied`,
/// displacements before it in the common unit; one of each per frame. O(frames).
std::optional<SegmentTie> tie_by_speed(std::span<const double> time_s, FrameRange run,
                                       std::span<const std::optional<double>> moved,
                                       std::span<const std::optional<double>> tied,
                                       const SegmentTieOptions& options = {});

/// By the relation of alignment error and displacement, learned before the loss and applied after it (SSS
/// 3.5). sigma is `relation_sigma`. None without errors, or if there is nothing to learn from.
/// O(window * separations).
std::optional<SegmentTie> tie_by_relation(const MotionEvidence& evidence, FrameRange run,
                                          std::span<const std::optional<double>> moved,
                                          std::span<const std::optional<double>> tied,
                                          const SegmentTieOptions& options = {});

/// Both combined, weighted by inverse variance; where one is missing, the other.
std::optional<SegmentTie> combined(const std::optional<SegmentTie>& a, const std::optional<SegmentTie>& b);

}  // namespace vo
