#pragma once

#include "support/made_errors.hpp"

#include <cmath>
#include <cstddef>
#include <vector>

#include <vo/base/rng.hpp>
#include <vo/motion/alignment_error.hpp>
#include <vo/motion/displacement_track.hpp>
#include <vo/motion/motion_evidence.hpp>

namespace test_support {

/// A walk at 25 frames/s whose displacement at every frame is known, and what each source says of it.
struct KnownMotion {
  std::vector<double> time_s;
  std::vector<double> metres;  ///< of each frame since the one before
  vo::AlignmentErrors errors;
  vo::DisplacementTrack track;

  [[nodiscard]] std::size_t frames() const { return metres.size(); }

  /// All that is known, pointing into this object.
  [[nodiscard]] vo::MotionEvidence evidence() const {
    return {.time_s = time_s,
            .track = &track,
            .errors = &errors,
            .errors_known = std::vector<bool>(frames(), true)};
  }

  /// Loses the track over frames [begin, end); what follows is a new segment, in a unit of `metres_per_unit`.
  void lose(std::size_t begin, std::size_t end, double metres_per_unit) {
    for (std::size_t i = begin; i < frames(); ++i) {
      vo::TrackedDisplacement& frame = track.frames[i];
      if (i < end) {
        frame.valid = false;
        frame.loss = vo::TrackLoss::kTooFewCorners;
      } else {
        ++frame.segment;
        frame.displacement = metres[i] / metres_per_unit;
      }
    }
  }
};

/// A walk of `seconds` whose speed swings slowly between `slow` and `fast` metres per second. The alignment
/// error grows with the way between two frames and flattens out; `bent` is how much.
inline KnownMotion known_motion(double seconds, double slow, double fast, double bent = 0.3) {
  KnownMotion walk;
  constexpr double kRate_hz = 25, kPeriod_s = 9;
  const auto frames = static_cast<std::size_t>(seconds * kRate_hz);
  std::vector<double> travelled;
  double sum = 0;
  for (std::size_t i = 0; i < frames; ++i) {
    const double t = static_cast<double>(i) / kRate_hz;
    const double speed = (slow + fast) / 2 + (fast - slow) / 2 * std::sin(2 * 3.14159265 * t / kPeriod_s);
    walk.time_s.push_back(t);
    walk.metres.push_back(i == 0 ? 0 : speed / kRate_hz);
    travelled.push_back(sum += walk.metres.back());
    walk.track.frames.push_back({.valid = i > 0, .displacement = walk.metres.back(), .sigma = 0});
  }
  walk.errors = made_errors(frames, kRate_hz, 10, [&](std::size_t i, std::size_t j) {
    const double way = travelled[j] - travelled[i];
    return way / (1 + bent * way);
  });
  return walk;
}

inline double sum(const std::vector<double>& values, std::size_t begin, std::size_t end) {
  double total = 0;
  for (std::size_t i = begin; i < end; ++i) total += values[i];
  return total;
}

}  // namespace test_support
