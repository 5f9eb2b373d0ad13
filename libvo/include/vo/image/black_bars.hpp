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
/// A bar is from a fiftieth to two fifths of the picture high (or wide), is black in every picture, and ends
/// at a straight edge: in a quarter of the pictures, within eight pixels of it comes a row (column) at least
/// half of which is lit. A night sky is black too, but ends at roofs and lamps. A bar on one side is at most
/// a quarter high; where the other side is black as far, it is taken to have the same. `pictures`: of one
/// size, 8 bits, grey, from all over the walk; those that are black all over say nothing. O(pixels).
std::optional<cv::Rect> find_black_bars(std::span<const cv::Mat> pictures);

}  // namespace vo
