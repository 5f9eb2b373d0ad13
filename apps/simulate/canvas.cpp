#include "canvas.hpp"

#include "noise.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <opencv2/imgproc.hpp>

namespace simulate {

Colour hsv(const Hsv& colour) {
  const auto [hue_deg, saturation, value] = colour;
  const auto channel = [&](double offset) {
    const double k = std::fmod(offset + hue_deg / 60, 6.0);
    return 255 * (value - value * saturation * std::clamp(std::min(k, 4 - k), 0.0, 1.0));
  };
  return {channel(1), channel(3), channel(5)};
}

Colour scaled(const Colour& colour, double by) {
  return {std::min(255.0, colour[0] * by), std::min(255.0, colour[1] * by), std::min(255.0, colour[2] * by)};
}

Colour near(const Colour& colour, double spread, vo::Rng& rng) {
  Colour result;
  for (int c = 0; c < 3; ++c) result[c] = std::clamp(colour[c] + rng.uniform(-spread, spread), 0.0, 255.0);
  return result;
}

Canvas::Canvas(cv::Size texels, cv::Size2d extent_m, const Colour& ground)
    : extent_m_(extent_m),
      scale_x_(texels.width / extent_m.width),
      scale_y_(texels.height / extent_m.height) {
  painting_.colour.create(texels);
  painting_.colour.setTo(ground);
}

cv::Point Canvas::texel(cv::Point2d at_m) const {
  return {static_cast<int>(std::lround(at_m.x * scale_x_)), static_cast<int>(std::lround(at_m.y * scale_y_))};
}

cv::Rect Canvas::texels(const cv::Rect2d& area_m) const {
  return cv::Rect(texel(area_m.tl()), texel(area_m.br())) & cv::Rect({0, 0}, painting_.colour.size());
}

void Canvas::fill(const cv::Rect2d& area_m, const Colour& colour) {
  painting_.colour(texels(area_m)).setTo(colour);
}

void Canvas::glow(const cv::Rect2d& area_m, const Colour& colour) {
  if (painting_.glow.empty()) painting_.glow = cv::Mat3b::zeros(painting_.colour.size());
  const cv::Rect area = texels(area_m);
  if (area.empty()) return;
  // Light from inside shows what is in the window: it takes on the painting's brightness.
  cv::Mat lit;
  cv::multiply(painting_.colour(area), cv::Scalar(colour[0], colour[1], colour[2]) / 255.0, lit, 1, CV_8U);
  lit += scaled(colour, 0.35);
  lit.copyTo(painting_.glow(area));
}

void Canvas::line(cv::Point2d from_m, cv::Point2d to_m, double width_m, const Colour& colour) {
  const int width = std::max(1, static_cast<int>(std::lround(width_m * scale_x_)));
  cv::line(painting_.colour, texel(from_m), texel(to_m), colour, width, cv::LINE_AA);
}

void Canvas::ellipse(cv::Point2d centre_m, cv::Size2d radii_m, const Colour& colour) {
  const cv::Size radii(std::max(1, static_cast<int>(std::lround(radii_m.width * scale_x_))),
                       std::max(1, static_cast<int>(std::lround(radii_m.height * scale_y_))));
  cv::ellipse(painting_.colour, texel(centre_m), radii, 0, 0, 360, colour, cv::FILLED, cv::LINE_AA);
}

void Canvas::text(const cv::Rect2d& area_m, const std::string& writing, const Colour& colour) {
  const cv::Rect area = texels(area_m);
  if (area.empty()) return;
  int baseline = 0;
  const cv::Size unit = cv::getTextSize(writing, cv::FONT_HERSHEY_DUPLEX, 1, 2, &baseline);
  const double scale = std::min(0.7 * area.height / unit.height, 0.92 * area.width / unit.width);
  const cv::Size size(static_cast<int>(unit.width * scale), static_cast<int>(unit.height * scale));
  const cv::Point origin(area.x + (area.width - size.width) / 2, area.y + (area.height + size.height) / 2);
  cv::putText(painting_.colour, writing, origin, cv::FONT_HERSHEY_DUPLEX, scale, colour,
              std::max(1, static_cast<int>(std::lround(2.2 * scale))), cv::LINE_AA);
}

void Canvas::clutter(const cv::Rect2d& area_m, int shapes, vo::Rng& rng) {
  const cv::Rect area = texels(area_m);
  if (area.empty()) return;
  cv::Mat view = painting_.colour(area);
  const auto inside = [&] {
    return cv::Point{static_cast<int>(rng.index(static_cast<std::uint64_t>(area.width))),
                     static_cast<int>(rng.index(static_cast<std::uint64_t>(area.height)))};
  };
  for (int i = 0; i < shapes; ++i) {
    const Colour colour = hsv({rng.uniform(0, 360), rng.uniform(0, 0.7), rng.uniform(0.1, 0.95)});
    const cv::Point a = inside();
    const int size =
        std::max(1, static_cast<int>(rng.uniform(0.05, 0.3) * std::min(area.width, area.height)));
    switch (rng.index(3)) {
      case 0:
        cv::rectangle(view, cv::Rect(a, cv::Size(size, 1 + static_cast<int>(size * rng.uniform(0.3, 2)))),
                      colour, cv::FILLED);
        break;
      case 1:
        cv::circle(view, a, std::max(1, size / 2), colour, cv::FILLED, cv::LINE_AA);
        break;
      default:
        cv::line(view, a, inside(), colour, std::max(1, size / 6), cv::LINE_AA);
    }
  }
}

void Canvas::stain(const cv::Rect2d& area_m, cv::Size2d feature_m, double strength, std::uint32_t seed) {
  const cv::Rect area = texels(area_m);
  if (area.empty()) return;
  const cv::Mat1f noise = fractal_image(
      area.size(), {std::max(1.0, feature_m.width * scale_x_), std::max(1.0, feature_m.height * scale_y_)},
      seed);
  for (int y = 0; y < area.height; ++y) {
    for (int x = 0; x < area.width; ++x) {
      cv::Vec3b& pixel = painting_.colour(area.y + y, area.x + x);
      const float by = 1.0F + static_cast<float>(strength) * 2.0F * noise(y, x);
      for (int c = 0; c < 3; ++c)
        pixel[c] = cv::saturate_cast<std::uint8_t>(static_cast<float>(pixel[c]) * by);
    }
  }
}

std::string made_up_word(vo::Rng& rng) {
  static constexpr std::array kSyllables{"KA", "LO",  "MI", "TER", "BAN", "RO", "SEL", "VI", "NO", "DU",
                                         "PA", "RIN", "FO", "GE",  "HAL", "ZE", "CUT", "OR", "AL", "BE"};
  std::string word;
  for (std::uint64_t i = 2 + rng.index(3); i > 0; --i) word += kSyllables[rng.index(kSyllables.size())];
  return word;
}

}  // namespace simulate
