#pragma once

#include <optional>
#include <string>

#include <opencv2/core/mat.hpp>

namespace retrace {

/// One picture of a run's video: the query above, the reference below it, and where on the route that is.
struct SideView {
  cv::Mat query;      ///< BGR
  cv::Mat reference;  ///< BGR; empty: off the route
  std::string query_caption, reference_caption;
  std::optional<double> along;  ///< share of the route walked, 0 to 1; none: off the route
  std::string status;           ///< distance and probability
  std::string route_end;        ///< what is written at the end of the position bar
};

/// Sizes of such pictures, in even pixels.
struct SideViewLayout {
  cv::Size query, reference;  ///< of the two pictures; what has another shape is fitted in

  [[nodiscard]] cv::Size size() const;
  /// Where the position bar begins and ends, in the whole picture.
  [[nodiscard]] cv::Point bar_begin() const;
  [[nodiscard]] cv::Point bar_end() const;
};

/// The layout for recordings of these sizes: as wide as `width_px`, and at most three quarters of that high
/// for each of the two.
SideViewLayout side_view_layout(cv::Size query, cv::Size reference, int width_px);

/// Draws it.
cv::Mat draw_side_view(const SideView& view, const SideViewLayout& layout);

}  // namespace retrace
