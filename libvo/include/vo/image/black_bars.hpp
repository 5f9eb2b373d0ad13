#pragma once

#include <optional>
#include <span>

#include <opencv2/core/mat.hpp>

namespace vo {

/// True if the picture has a rim that may be a black bar (`find_black_bars`): cheap, for the first picture of
/// a walk.
bool may_have_black_bars(const cv::Mat& grey);

/// The part of a walk's pictures between black bars, as editors and players put them above and below or
/// beside pictures of another shape; none if there are none.
///
/// A bar takes a fiftieth to two fifths of the picture's height (or width), has one level in every picture,
/// black or a dark grey of up to 48, but for noise and one pixel in a hundred, and ends at a straight edge:
/// in a quarter of the pictures a row (column) within eight pixels of the edge is brighter over at least half
/// its length. A night sky is black too, but ends at roofs and lamps. A bar on one side only takes at most a
/// quarter; if the other side is black as far in, it counts as a bar of the same size. `pictures`: of one
/// size, 8 bits, grey, from all over the walk; entirely black ones are ignored. O(pixels).
std::optional<cv::Rect> find_black_bars(std::span<const cv::Mat> pictures);

}  // namespace vo
