#pragma once

#include <optional>
#include <vector>

#include <opencv2/core.hpp>

namespace simulate {

/// What keeps a camera from showing how it moves (SSS 5.2: "high camera speed, sharp turns and low-light or
/// featureless environments").
enum class FailureKind {
  kBlackout,   ///< nothing but noise
  kBlur,       ///< far out of focus
  kPan,        ///< the camera is turned aside and back, fast
  kBlankWall,  ///< a wall without texture fills the picture
};

/// A stretch of time in which it fails.
struct Failure {
  FailureKind kind = FailureKind::kBlackout;
  double begin_s = 0;
  double end_s = 0;
};

/// So many failures of so many seconds, spread evenly over a walk, one kind after another. Throws `vo::Error`
/// if they would overlap.
std::vector<Failure> spread_failures(int count, double length_s, double walk_s);

/// The failure at a time, if there is one.
std::optional<Failure> failure_at(const std::vector<Failure>& failures, double time_s);

/// How far to the right a failing camera is turned, radians: out and back in a pan, 0 otherwise.
double pan_rad(const Failure& failure, double time_s);

/// Takes from a picture (CV_8UC3) what the failure takes; a pan takes nothing.
void spoil(cv::Mat& bgr, FailureKind kind);

}  // namespace simulate
