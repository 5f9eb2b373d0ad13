#pragma once

#include "lighting.hpp"

#include <cstdint>
#include <string>

#include <opencv2/core.hpp>

#include <vo/base/rng.hpp>

namespace simulate {

/// Blue, green, red; 0 to 255.
using Colour = cv::Scalar;

/// Hue in degrees, saturation and value from 0 to 1. Values in braces are worked out from left to right with
/// every compiler, arguments are not; so whatever draws two random numbers draws them in braces or one by
/// one.
struct Hsv {
  double hue_deg, saturation, value;
};
Colour hsv(const Hsv& colour);
/// The colour made lighter or darker.
Colour scaled(const Colour& colour, double by);
/// A colour near another, each channel moved by up to `spread`.
Colour near(const Colour& colour, double spread, vo::Rng& rng);

/// Draws a painting in metres: x to the right, y down from the top left corner.
class Canvas {
 public:
  /// `extent_m` is what the texture covers.
  Canvas(cv::Size texels, cv::Size2d extent_m, const Colour& ground);

  void fill(const cv::Rect2d& area_m, const Colour& colour);
  void glow(const cv::Rect2d& area_m, const Colour& colour);
  void line(cv::Point2d from_m, cv::Point2d to_m, double width_m, const Colour& colour);
  void ellipse(cv::Point2d centre_m, cv::Size2d radii_m, const Colour& colour);
  /// Writing that fills the area's height as far as its width allows.
  void text(const cv::Rect2d& area_m, const std::string& writing, const Colour& colour);
  /// A picture of random shapes: a poster, goods in a shop window, a curtain.
  void clutter(const cv::Rect2d& area_m, int shapes, vo::Rng& rng);
  /// Stains from `feature_m` down to single texels, `strength` of the brightness up and down.
  void stain(const cv::Rect2d& area_m, cv::Size2d feature_m, double strength, std::uint32_t seed);

  [[nodiscard]] cv::Size2d extent_m() const { return extent_m_; }
  Painting& painting() { return painting_; }

 private:
  [[nodiscard]] cv::Rect texels(const cv::Rect2d& area_m) const;
  [[nodiscard]] cv::Point texel(cv::Point2d at_m) const;

  Painting painting_;
  cv::Size2d extent_m_;
  double scale_x_, scale_y_;  // texels per metre
};

/// A made-up word of two to four syllables.
std::string made_up_word(vo::Rng& rng);

}  // namespace simulate
