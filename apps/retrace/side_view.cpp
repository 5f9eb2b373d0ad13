#include "side_view.hpp"

#include <algorithm>
#include <cmath>

#include <opencv2/imgproc.hpp>

namespace retrace {
namespace {

constexpr int kStrip_px = 64, kMargin_px = 14, kCaption_px = 22, kBarFromBottom_px = 18;
constexpr double kText = 0.45, kLargeText = 0.9;
const cv::Scalar kPaper(28, 26, 24), kInk(235, 235, 235), kFaint(130, 126, 120), kMarker(60, 170, 255);

cv::Size text_size(const std::string& text, double scale) {
  int below = 0;
  return cv::getTextSize(text, cv::FONT_HERSHEY_SIMPLEX, scale, 1, &below);
}

void write(cv::Mat& page, const std::string& text, cv::Point at, const cv::Scalar& colour = kInk,
           double scale = kText) {
  cv::putText(page, text, at, cv::FONT_HERSHEY_SIMPLEX, scale, colour, 1, cv::LINE_AA);
}

/// The scale at which a text is no wider than `width_px`.
double fitting(const std::string& text, int width_px) {
  return std::min(kText, kText * width_px / std::max(1, text_size(text, kText).width));
}

/// The picture as large as fits into a part of the page, in its middle.
void place_picture(cv::Mat page, const cv::Mat& picture) {
  const double scale =
      std::min(static_cast<double>(page.cols) / picture.cols, static_cast<double>(page.rows) / picture.rows);
  const cv::Size size(std::clamp(static_cast<int>(std::lround(picture.cols * scale)), 1, page.cols),
                      std::clamp(static_cast<int>(std::lround(picture.rows * scale)), 1, page.rows));
  cv::Mat part =
      page(cv::Rect((page.cols - size.width) / 2, (page.rows - size.height) / 2, size.width, size.height));
  if (size == picture.size()) {
    picture.copyTo(part);
  } else {
    cv::resize(picture, part, size, 0, 0, scale < 1 ? cv::INTER_AREA : cv::INTER_LINEAR);
  }
}

/// Light on a darkened band, so that it can be read on any picture.
void write_caption(cv::Mat page, const std::string& text) {
  cv::Mat band = page(cv::Rect(0, 0, std::min(page.cols, text_size(text, kText).width + 2 * kMargin_px),
                               std::min(page.rows, kCaption_px)));
  band *= 0.35;
  write(page, text, {kMargin_px, kCaption_px - 7}, kInk, fitting(text, page.cols - 2 * kMargin_px));
}

void draw_position(cv::Mat& page, const SideView& view, const SideViewLayout& layout) {
  const cv::Point begin = layout.bar_begin(), end = layout.bar_end();
  const int length = text_size(view.route_end, kText).width;
  write(page, view.status, {begin.x, begin.y - 20}, kInk,
        fitting(view.status, end.x - begin.x - length - kMargin_px));
  write(page, view.route_end, {end.x - length, end.y - 20}, kFaint);
  cv::line(page, begin, end, kFaint, 3, cv::LINE_AA);
  if (!view.along) return;
  const double along = std::clamp(*view.along, 0.0, 1.0);
  const cv::Point here(static_cast<int>(std::lround(std::lerp(begin.x, end.x, along))), begin.y);
  cv::line(page, begin, here, kMarker, 3, cv::LINE_AA);
  cv::circle(page, here, 6, kMarker, cv::FILLED, cv::LINE_AA);
}

int even(double value) {
  return std::max(2, 2 * static_cast<int>(std::lround(value / 2)));
}

}  // namespace

cv::Size SideViewLayout::size() const {
  return {query.width, query.height + reference.height + kStrip_px};
}
cv::Point SideViewLayout::bar_begin() const {
  return {kMargin_px, size().height - kBarFromBottom_px};
}
cv::Point SideViewLayout::bar_end() const {
  return {size().width - kMargin_px, size().height - kBarFromBottom_px};
}

SideViewLayout side_view_layout(cv::Size query, cv::Size reference, int width_px) {
  const int width = even(width_px);
  const auto fitted = [&](cv::Size of) {
    return cv::Size(width, even(std::min(0.75, static_cast<double>(of.height) / of.width) * width));
  };
  return {.query = fitted(query), .reference = fitted(reference)};
}

cv::Mat draw_side_view(const SideView& view, const SideViewLayout& layout) {
  cv::Mat page(layout.size(), CV_8UC3, kPaper);
  cv::Mat above = page(cv::Rect({0, 0}, layout.query));
  cv::Mat below = page(cv::Rect({0, layout.query.height}, layout.reference));
  place_picture(above, view.query);
  write_caption(above, view.query_caption);
  if (view.reference.empty()) {
    constexpr const char* kOffRoute = "off route";
    const cv::Size size = text_size(kOffRoute, kLargeText);
    write(below, kOffRoute, {(below.cols - size.width) / 2, (below.rows + size.height) / 2}, kInk,
          kLargeText);
  } else {
    place_picture(below, view.reference);
    write_caption(below, view.reference_caption);
  }
  cv::line(page, {0, layout.query.height}, {page.cols, layout.query.height}, kPaper, 1);
  draw_position(page, view, layout);
  return page;
}

}  // namespace retrace
