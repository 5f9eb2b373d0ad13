#include "failure.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

#include <vo/base/error.hpp>

namespace simulate {

std::vector<Failure> spread_failures(int count, double length_s, double walk_s) {
  constexpr std::array kKinds{FailureKind::kBlackout, FailureKind::kBlur, FailureKind::kPan,
                              FailureKind::kBlankWall};
  if (length_s * (count + 1) > walk_s && count > 0)
    throw vo::Error("failure-s",
                    fmt::format("is {:g}, and {} of them do not fit into {:.1f} s", length_s, count, walk_s),
                    "fewer or shorter failures, or a longer walk");
  std::vector<Failure> failures;
  for (int i = 0; i < count; ++i) {
    const double middle_s = walk_s * (i + 1) / (count + 1);
    failures.push_back({kKinds[static_cast<std::size_t>(i) % kKinds.size()], middle_s - length_s / 2,
                        middle_s + length_s / 2});
  }
  return failures;
}

std::optional<Failure> failure_at(const std::vector<Failure>& failures, double time_s) {
  const auto found = std::ranges::find_if(
      failures, [&](const Failure& f) { return f.begin_s <= time_s && time_s < f.end_s; });
  return found == failures.end() ? std::nullopt : std::optional(*found);
}

double pan_rad(const Failure& failure, double time_s) {
  if (failure.kind != FailureKind::kPan) return 0;
  constexpr double kFurthest_rad = 2 * std::numbers::pi / 3;
  const double share = (time_s - failure.begin_s) / (failure.end_s - failure.begin_s);
  return kFurthest_rad * std::pow(std::sin(std::numbers::pi * share), 2);
}

void spoil(cv::Mat& bgr, FailureKind kind) {
  switch (kind) {
    case FailureKind::kBlackout:
      bgr.setTo(cv::Scalar::all(0));
      break;
    case FailureKind::kBlur:
      cv::GaussianBlur(bgr, bgr, {}, bgr.cols / 40.0);
      break;
    case FailureKind::kBlankWall:
      bgr.setTo(cv::Scalar(165, 172, 176));
      break;
    case FailureKind::kPan:
      break;
  }
}

}  // namespace simulate
