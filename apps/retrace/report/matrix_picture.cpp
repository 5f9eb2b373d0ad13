#include "matrix_picture.hpp"

#include <algorithm>
#include <cmath>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

namespace retrace {
namespace {

/// The least cost of each block of `shrink` x `shrink` cells; reference upwards, query to the right.
cv::Mat shrunk(const place::CostMatrix& matrix, std::size_t shrink) {
  const auto rows = static_cast<int>((matrix.references + shrink - 1) / shrink);
  const auto columns = static_cast<int>((matrix.queries + shrink - 1) / shrink);
  cv::Mat picture(rows, columns, CV_32FC1, cv::Scalar(HUGE_VALF));
  for (std::size_t q = 0; q < matrix.queries; ++q) {
    for (std::size_t r = 0; r < matrix.references; ++r) {
      float& cell = picture.at<float>(rows - 1 - static_cast<int>(r / shrink), static_cast<int>(q / shrink));
      cell = std::fmin(cell, matrix.at(q, r));  // fmin ignores NaN
    }
  }
  return picture;
}

std::size_t shrink_to(const place::CostMatrix& matrix, int side_px) {
  const std::size_t longer = std::max({matrix.queries, matrix.references, std::size_t{1}});
  return (longer + static_cast<std::size_t>(side_px) - 1) / static_cast<std::size_t>(side_px);
}

/// Grey from the 1st to the 99th percentile of the costs.
cv::Mat as_grey(const cv::Mat& costs) {
  std::vector<float> sorted(costs.begin<float>(), costs.end<float>());
  std::erase_if(sorted, [](float value) { return !std::isfinite(value); });
  if (sorted.empty()) return cv::Mat(costs.size(), CV_8UC1, cv::Scalar(128));
  std::ranges::sort(sorted);
  const double low = sorted[sorted.size() / 100];
  const double high = std::max<double>(sorted[sorted.size() - 1 - sorted.size() / 100], low + 1e-6);
  cv::Mat grey;
  costs.convertTo(grey, CV_8UC1, 255 / (high - low), -255 * low / (high - low));
  return grey;
}

std::vector<std::uint8_t> as_png(const cv::Mat& picture) {
  std::vector<std::uint8_t> png;
  cv::imencode(".png", picture, png);
  return png;
}

}  // namespace

std::vector<std::uint8_t> matrix_picture(const place::CostMatrix& enhanced,
                                         const std::vector<place::Match>& matches,
                                         const std::string& traverse, int side_px, std::size_t cell) {
  const std::size_t longer = std::max({enhanced.queries, enhanced.references, std::size_t{1}});
  const std::size_t shrink = shrink_to(enhanced, side_px);
  const int enlarge = std::max(1, side_px / static_cast<int>((longer + shrink - 1) / shrink));
  cv::Mat picture;
  cv::resize(as_grey(shrunk(enhanced, shrink)), picture, {}, enlarge, enlarge, cv::INTER_NEAREST);
  cv::cvtColor(picture, picture, cv::COLOR_GRAY2BGR);

  const double scale = static_cast<double>(enlarge) / static_cast<double>(shrink * cell);
  for (std::size_t q = 0; q < matches.size(); ++q) {
    const place::Match& match = matches[q];
    if (!match.place || match.place->traverse != traverse) continue;
    const cv::Point centre(
        static_cast<int>((static_cast<double>(q) + 0.5) * scale),
        picture.rows - 1 - static_cast<int>((static_cast<double>(match.place->keyframe) + 0.5) * scale));
    const cv::Scalar orange(0, 128, 255), blue(255, 160, 60);
    if (match.accepted) cv::circle(picture, centre, 3, orange, cv::FILLED, cv::LINE_AA);
    if (!match.accepted) cv::circle(picture, centre, 3, blue, 1, cv::LINE_AA);
  }
  return as_png(picture);
}

std::vector<std::uint8_t> cost_picture(const place::CostMatrix& costs, int side_px) {
  constexpr int kStep = 8;  // of grey: finer noise makes a much larger file and looks the same
  const cv::Mat grey = as_grey(shrunk(costs, shrink_to(costs, side_px)));
  return as_png(grey / kStep * kStep);
}

}  // namespace retrace
