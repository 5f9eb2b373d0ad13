#include "vo/tracks/klt_tracking.hpp"

#include "vo/base/parallel.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <opencv2/video/tracking.hpp>

namespace vo {
namespace {

struct Followed {
  std::vector<cv::Point2f> at;
  std::vector<uchar> found;
};

Followed flow(const KltPyramid& before, const KltPyramid& after, const std::vector<cv::Point2f>& points,
              const std::vector<cv::Point2f>& guess, const KltOptions& options) {
  Followed followed{.at = guess, .found = {}};
  const cv::TermCriteria stop(cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 20, 0.02);
  cv::calcOpticalFlowPyrLK(before, after, points, followed.at, followed.found, cv::noArray(),
                           {options.window_px, options.window_px}, options.levels, stop,
                           cv::OPTFLOW_USE_INITIAL_FLOW);
  return followed;
}

}  // namespace

KltPyramid klt_pyramid(const cv::Mat& grey, const KltOptions& options) {
  if (grey.empty() || grey.type() != CV_8UC1)
    throw std::invalid_argument("klt_pyramid: a grey picture of 8 bits expected");
  if (options.window_px < 3 || options.window_px % 2 == 0 || options.levels < 0)
    throw std::invalid_argument("klt_pyramid: an odd window_px >= 3 and levels >= 0 expected");
  KltPyramid pyramid;
  cv::buildOpticalFlowPyramid(grey, pyramid, {options.window_px, options.window_px}, options.levels);
  return pyramid;
}

std::vector<std::optional<cv::Point2f>> follow(const KltPyramid& before, const KltPyramid& after,
                                               std::span<const cv::Point2f> points,
                                               std::span<const cv::Point2f> guess,
                                               const KltOptions& options) {
  if (before.empty() || before.size() != after.size() || before[0].size() != after[0].size())
    throw std::invalid_argument("follow: two pyramids of one size expected");
  if (points.size() != guess.size()) throw std::invalid_argument("follow: one guess for each point expected");
  std::vector<std::optional<cv::Point2f>> result(points.size());
  const auto width = static_cast<float>(before[0].cols), height = static_cast<float>(before[0].rows);
  constexpr std::size_t kPart = 64;  // enough to pay for the call
  parallel_for((points.size() + kPart - 1) / kPart, [&](std::size_t part) {
    const std::size_t begin = part * kPart, count = std::min(kPart, points.size() - begin);
    const auto cut = [&](std::span<const cv::Point2f> all) {
      const auto piece = all.subspan(begin, count);
      return std::vector<cv::Point2f>(piece.begin(), piece.end());
    };
    const std::vector<cv::Point2f> from = cut(points);
    const Followed there = flow(before, after, from, cut(guess), options);
    const Followed back = flow(after, before, there.at, from, options);
    for (std::size_t i = 0; i < count; ++i) {
      const cv::Point2f at = there.at[i], off = back.at[i] - from[i];
      const bool inside = at.x >= 0 && at.y >= 0 && at.x <= width - 1 && at.y <= height - 1;
      if (there.found[i] != 0 && back.found[i] != 0 && inside &&
          std::hypot(off.x, off.y) <= options.max_round_trip_px) {
        result[begin + i] = at;
      }
    }
  });
  return result;
}

}  // namespace vo
