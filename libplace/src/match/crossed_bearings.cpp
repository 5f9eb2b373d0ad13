#include "place/match/crossed_bearings.hpp"

#include <cmath>
#include <vector>

namespace place {
namespace {

constexpr double kPriorX_m = 10, kPriorY_m = 3;
// A line's standard deviation at a distance: of the known place, and of the angle (3 degrees are usual of
// bearings by a hundred points).
constexpr double kPlace_m = 0.05, kAngle_rad = 0.06;
constexpr double kBehind = 0.1;  // weight of a line that points away

struct Line {
  double x_m, y_m;     // it passes through
  double east, north;  // where it points

  /// How far to its right a place lies.
  [[nodiscard]] double off_m(double x, double y) const { return (x - x_m) * north - (y - y_m) * east; }
  [[nodiscard]] double ahead_m(double x, double y) const { return (x - x_m) * east + (y - y_m) * north; }
  [[nodiscard]] double sd_m(double x, double y) const {
    return kPlace_m + kAngle_rad * std::hypot(x - x_m, y - y_m);
  }
};

}  // namespace

std::optional<CrossedPlace> cross_bearings(std::span<const Bearing> bearings) {
  if (bearings.size() < 2) return std::nullopt;
  std::vector<Line> lines;
  for (const auto& [x_m, y_m, bearing_rad] : bearings)
    lines.push_back({x_m, y_m, std::sin(bearing_rad), std::cos(bearing_rad)});
  CrossedPlace place;
  constexpr int kRounds = 15;
  for (int round = 0; round < kRounds; ++round) {
    double xx = 1 / (kPriorX_m * kPriorX_m), xy = 0, yy = 1 / (kPriorY_m * kPriorY_m), x = 0, y = 0;
    for (const Line& line : lines) {
      double weight = 1;  // at first all lines count alike
      if (round > 0) {
        const double sd_m = line.sd_m(place.x_m, place.y_m);
        const double off = line.off_m(place.x_m, place.y_m) / sd_m;
        weight = 1 / (sd_m * sd_m) / (1 + off * off);
        if (line.ahead_m(place.x_m, place.y_m) < 0) weight *= kBehind;
      }
      const double nx = line.north, ny = -line.east, at = nx * line.x_m + ny * line.y_m;
      xx += weight * nx * nx;
      xy += weight * nx * ny;
      yy += weight * ny * ny;
      x += weight * nx * at;
      y += weight * ny * at;
    }
    const double determinant = xx * yy - xy * xy;  // > 0 by the prior
    place = {(yy * x - xy * y) / determinant, (xx * y - xy * x) / determinant, std::sqrt(yy / determinant),
             std::sqrt(xx / determinant)};
  }
  std::size_t fit = 0;
  for (const Line& line : lines) {
    constexpr double kFit = 2;  // standard deviations
    const double sd_m = line.sd_m(place.x_m, place.y_m);
    fit += std::abs(line.off_m(place.x_m, place.y_m)) <= kFit * sd_m ? 1 : 0;
  }
  if (fit < 2 || 2 * fit <= lines.size()) return std::nullopt;
  return place;
}

}  // namespace place
