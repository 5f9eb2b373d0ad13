#include "vo/gait/thumbnail_motion.hpp"

#include "vo/base/median.hpp"
#include "vo/base/parallel.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Dense>
#include <opencv2/imgproc.hpp>

namespace vo {
namespace {

using Vector5 = Eigen::Matrix<double, 5, 1>;  // right, down, growth, roll, brightness
using Matrix5 = Eigen::Matrix<double, 5, 5>;

/// A thumbnail and its halves, each less noisy than the one before.
std::vector<cv::Mat> pyramid_of(std::span<const std::uint8_t> thumbnail, const cv::Size& size) {
  constexpr int kSmallest_px = 8;
  cv::Mat picture(size, CV_32FC1);
  std::ranges::copy(thumbnail, picture.begin<float>());
  std::vector<cv::Mat> pyramid{picture};
  while (std::min(pyramid.back().rows, pyramid.back().cols) >= 2 * kSmallest_px) {
    cv::Mat half;
    cv::pyrDown(pyramid.back(), half);
    pyramid.push_back(half);
  }
  return pyramid;
}

/// The picture as it was before it moved by `motion`, in pixels of the frame `scale` times as large.
cv::Mat moved_back(const cv::Mat& picture, const Vector5& motion, const cv::Point2d& scale) {
  const double middle_x = (picture.cols - 1) / 2.0, middle_y = (picture.rows - 1) / 2.0;
  const double right = motion[0], down = motion[1], growth = motion[2], roll = motion[3];
  cv::Mat back(picture.size(), CV_32FC1);
  for (int row = 0; row < back.rows; ++row) {
    for (int column = 0; column < back.cols; ++column) {
      // Not cv::warpAffine, which rounds to 32nds of a pixel: a bounce may be as small as that.
      const double x_px = (column - middle_x) * scale.x, y_px = (row - middle_y) * scale.y;
      const double x =
          std::clamp(column + (right + growth * x_px - roll * y_px) / scale.x, 0.0, back.cols - 1.0);
      const double y = std::clamp(row + (down + growth * y_px + roll * x_px) / scale.y, 0.0, back.rows - 1.0);
      const int left = std::min(static_cast<int>(x), back.cols - 2),
                top = std::min(static_cast<int>(y), back.rows - 2);
      const auto across = [&](int at) {
        const float a = picture.at<float>(at, left), b = picture.at<float>(at, left + 1);
        return a + static_cast<float>(x - left) * (b - a);
      };
      const float above = across(top);
      back.at<float>(row, column) = above + static_cast<float>(y - top) * (across(top + 1) - above);
    }
  }
  return back;
}

/// One step of Gauss and Newton; false if the pictures show nothing.
bool refine(Vector5& motion, const cv::Mat& before, const cv::Mat& after, const cv::Point2d& scale,
            double unit_px) {
  const cv::Mat back = moved_back(after, motion, scale);
  const double middle_x = (before.cols - 1) / 2.0, middle_y = (before.rows - 1) / 2.0;
  std::vector<Vector5> rows;
  std::vector<double> differences, sizes;
  rows.reserve(before.total());
  differences.reserve(before.total());
  sizes.reserve(before.total());
  for (int y = 1; y + 1 < before.rows; ++y) {
    for (int x = 1; x + 1 < before.cols; ++x) {
      const auto slope = [&](const cv::Mat& p, int dx, int dy) {
        return (static_cast<double>(p.at<float>(y + dy, x + dx)) - p.at<float>(y - dy, x - dx)) / 2;
      };
      const double gx = (slope(before, 1, 0) + slope(back, 1, 0)) / 2 / scale.x;
      const double gy = (slope(before, 0, 1) + slope(back, 0, 1)) / 2 / scale.y;
      const double at_x = (x - middle_x) * scale.x / unit_px, at_y = (y - middle_y) * scale.y / unit_px;
      rows.emplace_back(gx, gy, gx * at_x + gy * at_y, gy * at_x - gx * at_y, 1);
      differences.push_back(static_cast<double>(before.at<float>(y, x)) - back.at<float>(y, x));
      sizes.push_back(std::abs(differences.back()));
    }
  }
  if (rows.empty()) return false;
  constexpr double kTolerance = 1.5, kLeast = 1;  // of the median difference; grey levels
  const double tolerance = kTolerance * std::max(kLeast, median(sizes));
  Matrix5 normal = Matrix5::Zero();
  Vector5 right_side = Vector5::Zero();
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const double off = differences[i] / tolerance, weight = 1 / (1 + off * off);
    normal.noalias() += weight * rows[i] * rows[i].transpose();
    right_side += weight * differences[i] * rows[i];
  }
  const Eigen::LDLT<Matrix5> solver(normal);
  constexpr double kSingular = 1e-9;
  const Vector5 pivots = solver.vectorD();
  if (!(pivots.minCoeff() > kSingular * pivots.maxCoeff())) return false;
  Vector5 step = solver.solve(right_side);
  step[2] /= unit_px;
  step[3] /= unit_px;
  motion += step;
  return motion.allFinite();
}

std::optional<PictureMotion> motion_between(const std::vector<cv::Mat>& before,
                                            const std::vector<cv::Mat>& after, const cv::Size& frame) {
  constexpr int kSteps = 2;  // on each level
  const double unit_px = frame.width / 4.0;
  Vector5 motion = Vector5::Zero();
  for (std::size_t level = before.size(); level-- > 0;) {
    const cv::Point2d scale(static_cast<double>(frame.width) / before[level].cols,
                            static_cast<double>(frame.height) / before[level].rows);
    motion[4] = 0;
    for (int step = 0; step < kSteps; ++step)
      if (!refine(motion, before[level], after[level], scale, unit_px)) return std::nullopt;
  }
  return PictureMotion{motion[0], motion[1], motion[2], motion[3]};
}

}  // namespace

std::vector<FrameMotion> thumbnail_motion(const ImageStack& thumbnails, cv::Size frame) {
  std::vector<FrameMotion> motion(thumbnails.size());
  if (std::min(thumbnails.width, thumbnails.height) < 3) return motion;  // no slopes
  const cv::Size size(thumbnails.width, thumbnails.height);
  std::vector<std::vector<cv::Mat>> pyramids(thumbnails.size());
  parallel_for(pyramids.size(), [&](std::size_t i) { pyramids[i] = pyramid_of(thumbnails[i], size); });
  parallel_for(motion.size(), [&](std::size_t i) {
    if (i > 0) motion[i].picture = motion_between(pyramids[i - 1], pyramids[i], frame);
  });
  return motion;
}

}  // namespace vo
