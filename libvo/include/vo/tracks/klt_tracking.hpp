#pragma once

#include <optional>
#include <span>
#include <vector>

#include <opencv2/core/mat.hpp>

namespace vo {

/// Settings of `follow`.
struct KltOptions {
  int window_px = 15;              ///< side of the tracked patch, odd
  int levels = 3;                  ///< halvings of the picture above it
  double max_round_trip_px = 0.7;  ///< a point that does not return to within this of its start is lost
};

/// A picture and its halvings, with the borders that tracking needs.
using KltPyramid = std::vector<cv::Mat>;

/// `grey`: 8 bit, one channel. O(pixels).
KltPyramid klt_pyramid(const cv::Mat& grey, const KltOptions& options = {});

/// Positions of the points of one picture in the next (Lucas and Kanade, pyramidal: Bouguet 2000), none where
/// they leave it or cannot be found: each is tracked there and back. `guess`: one for each point, where the
/// search begins. Throws `std::invalid_argument` unless both pyramids have the same size and KltOptions.
/// O(points), in parallel.
std::vector<std::optional<cv::Point2f>> follow(const KltPyramid& before, const KltPyramid& after,
                                               std::span<const cv::Point2f> points,
                                               std::span<const cv::Point2f> guess,
                                               const KltOptions& options = {});

}  // namespace vo
