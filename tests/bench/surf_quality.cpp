// How well SURF finds and recognises points after a change of the image, beside dlib's: prints a table.
//   surf_quality [points]
// Both give their strongest points, the same number, of a frame and of the changed frame. A pair of points is
// one place if the discs of 3 scales about them overlap to more than 60 % of their union (Mikolajczyk et al.
// 2005, an overlap error below 40 %). Repeatability is the share of points in view of both frames that have
// such a partner; matching score, the share of mutual nearest descriptors that are one place; orientation
// error, the median of |orientation change - rotation| of those.
#include "dlib_surf.hpp"
#include "frames.hpp"

#include <cmath>
#include <cstdlib>
#include <numbers>

#include <fmt/format.h>

#include <vo/surf/surf.hpp>
#include <vo/tracks/matching.hpp>

namespace {

struct Change {
  std::string name;
  double rotation_deg = 0, scale = 1, blur_px = 0, gain = 1, offset = 0;
};

const std::vector<Change> kChanges{
    {.name = "rotation 5 deg", .rotation_deg = 5},
    {.name = "rotation 10 deg", .rotation_deg = 10},
    {.name = "rotation 20 deg", .rotation_deg = 20},
    {.name = "rotation 45 deg", .rotation_deg = 45},
    {.name = "scale 0.6", .scale = 0.6},
    {.name = "scale 0.8", .scale = 0.8},
    {.name = "scale 1.25", .scale = 1.25},
    {.name = "scale 1.6", .scale = 1.6},
    {.name = "blur 1 px", .blur_px = 1},
    {.name = "blur 2 px", .blur_px = 2},
    {.name = "blur 3 px", .blur_px = 3},
    {.name = "brightness x 0.5", .gain = 0.5},
    {.name = "brightness x 0.7 + 40", .gain = 0.7, .offset = 40},
    {.name = "brightness x 1.3", .gain = 1.3},
};

/// From the frame to the changed frame.
cv::Matx23d map_of(const Change& change, cv::Size size) {
  const double angle = change.rotation_deg * std::numbers::pi / 180;
  const double c = change.scale * std::cos(angle), s = change.scale * std::sin(angle);
  const double x = (size.width - 1) / 2.0, y = (size.height - 1) / 2.0;
  return {c, -s, x - c * x + s * y, s, c, y - s * x - c * y};
}

cv::Mat apply(const Change& change, const cv::Mat& grey) {
  cv::Mat image = grey.clone();
  if (change.scale < 1) {  // what a camera further away sees has less detail
    const double blur = 0.5 * std::sqrt(1 / (change.scale * change.scale) - 1);
    cv::GaussianBlur(image, image, {}, blur);
  }
  if (change.rotation_deg != 0 || change.scale != 1)
    cv::warpAffine(image, image, map_of(change, grey.size()), grey.size(), cv::INTER_CUBIC,
                   cv::BORDER_REFLECT_101);
  if (change.blur_px > 0) cv::GaussianBlur(image, image, {}, change.blur_px);
  image.convertTo(image, -1, change.gain, change.offset);
  return image;
}

/// Common area of two discs over their union.
double overlap(double r, double s, double distance) {
  constexpr double kPi = std::numbers::pi;
  const double areas = kPi * (r * r + s * s);
  double common = 0;
  if (distance <= std::abs(r - s)) {
    common = kPi * std::min(r, s) * std::min(r, s);
  } else if (distance < r + s) {
    const double a = (distance * distance + r * r - s * s) / (2 * distance);
    const double b = distance - a;
    common = r * r * std::acos(a / r) - a * std::sqrt(r * r - a * a) + s * s * std::acos(b / s) -
             b * std::sqrt(std::max(0.0, s * s - b * b));
  }
  return common / (areas - common);
}

struct Score {
  double points = 0, repeated = 0, matched = 0;
  std::vector<double> orientation_errors_deg;

  void add(const Score& other) {
    points += other.points;
    repeated += other.repeated;
    matched += other.matched;
    orientation_errors_deg.insert(orientation_errors_deg.end(), other.orientation_errors_deg.begin(),
                                  other.orientation_errors_deg.end());
  }
  [[nodiscard]] double median_error_deg() {
    if (orientation_errors_deg.empty()) return 0;
    const auto middle =
        orientation_errors_deg.begin() + static_cast<std::ptrdiff_t>(orientation_errors_deg.size() / 2);
    std::nth_element(orientation_errors_deg.begin(), middle, orientation_errors_deg.end());
    return *middle;
  }
};

Score compare(const vo::Features& before, const vo::Features& after, const Change& change, cv::Size size) {
  const cv::Matx23d map = map_of(change, size);
  const auto moved = [&](const vo::Feature& point) { return map * cv::Vec3d(point.x_px, point.y_px, 1); };
  const auto one_place = [&](const vo::Feature& a, const vo::Feature& b) {
    const cv::Vec2d at = moved(a);
    return overlap(3 * a.scale_px * change.scale, 3 * b.scale_px,
                   std::hypot(at[0] - b.x_px, at[1] - b.y_px)) > 0.6;
  };
  cv::Matx23d back;
  cv::invertAffineTransform(map, back);
  const auto inside = [&](const cv::Vec2d& at) {
    return at[0] >= 0 && at[1] >= 0 && at[0] <= size.width - 1 && at[1] <= size.height - 1;
  };
  std::size_t seen_before = 0, seen_after = 0, repeated = 0;
  for (const auto& a : before.points) {
    if (!inside(moved(a))) continue;
    ++seen_before;
    repeated += std::ranges::any_of(after.points, [&](const auto& b) { return one_place(a, b); });
  }
  for (const auto& b : after.points) seen_after += inside(back * cv::Vec3d(b.x_px, b.y_px, 1));

  Score score{.points = static_cast<double>(std::min(seen_before, seen_after)),
              .repeated = static_cast<double>(std::min({repeated, seen_before, seen_after}))};
  for (const auto& match : vo::match_features(before, after, {.max_ratio = 1})) {
    const auto &a = before.points[match.from], &b = after.points[match.to];
    if (!one_place(a, b)) continue;
    ++score.matched;
    const double turn_deg = (b.orientation_rad - a.orientation_rad) * 180 / std::numbers::pi;
    score.orientation_errors_deg.push_back(std::abs(std::remainder(turn_deg - change.rotation_deg, 360)));
  }
  return score;
}

}  // namespace

int main(int argc, char** argv) {
  const std::size_t wanted = argc > 1 ? std::strtoul(argv[1], nullptr, 10) : 500;
  const auto frames = bench::assorted_frames();
  std::string names;
  for (const auto& frame : frames) names += (names.empty() ? "" : ", ") + frame.name;
  fmt::print("Strongest {} points or as many as both find, of {} frames: {}.\n\n", wanted, frames.size(),
             names);
  fmt::print("| change | repeatability | dlib | matching score | dlib | orientation error, deg | dlib |\n");
  fmt::print("|---|---|---|---|---|---|---|\n");
  Score ours_of_all, dlibs_of_all;
  const auto print = [](const std::string& name, Score& ours, Score& dlibs) {
    fmt::print("| {} | {:.3f} | {:.3f} | {:.3f} | {:.3f} | {:.2f} | {:.2f} |\n", name,
               ours.repeated / ours.points, dlibs.repeated / dlibs.points, ours.matched / ours.points,
               dlibs.matched / dlibs.points, ours.median_error_deg(), dlibs.median_error_deg());
  };
  for (const Change& change : kChanges) {
    Score ours, dlibs;
    for (const auto& frame : frames) {
      const cv::Mat changed = apply(change, frame.grey);
      const auto dlib_before = bench::dlib_surf(bench::dlib_image(frame.grey), wanted, 1);
      const auto dlib_after = bench::dlib_surf(bench::dlib_image(changed), wanted, 1);
      const auto surf = [&](const cv::Mat& image, std::size_t points) {
        return vo::detect_surf(image, {.detector = {.threshold = 0.5F, .max_points = points}});
      };
      const auto before = surf(frame.grey, dlib_before.size()), after = surf(changed, dlib_after.size());
      ours.add(compare(before, after, change, frame.grey.size()));
      dlibs.add(compare(dlib_before, dlib_after, change, frame.grey.size()));
    }
    print(change.name, ours, dlibs);
    ours_of_all.add(ours);
    dlibs_of_all.add(dlibs);
  }
  print("all", ours_of_all, dlibs_of_all);
}
