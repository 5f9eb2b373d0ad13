#include "vo/surf/hessian_detector.hpp"

#include "kernels/kernels.hpp"
#include "vo/base/parallel.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <optional>
#include <stdexcept>
#include <tuple>

#include <Eigen/Core>
#include <Eigen/LU>

namespace vo {
namespace {

constexpr int kBandRows = 40;              // of one task
constexpr double kScalePerLobe = 1.2 / 3;  // the 9 x 9 filter stands for a deviation of 1.2 (section 3.2)

/// Filter i of an octave, in the octave's pixels.
int lobe_px(int interval) {
  return 3 + 2 * interval;
}
int reach_px(int interval) {
  return (3 * lobe_px(interval) - 1) / 2;
}
/// Where a maximum may be: the filter above must fit on its neighbours.
int margin_px(int interval) {
  return reach_px(interval + 1) + 1;
}

struct Octave {
  const IntegralImage& integral;
  int step_px;
};

/// The responses of all intervals on three successive rows of an octave, which stay in the nearest cache.
class Responses {
 public:
  Responses(const Octave& octave, int intervals)
      : octave_(octave),
        stride_(octave.integral.stride + kernels::kLanes),
        scratch_(static_cast<std::size_t>(3 * stride_)),
        values_(static_cast<std::size_t>(3 * stride_ * intervals)),
        intervals_(intervals) {}

  /// Replaces row y - 3. A row without a filter's whole height is left as it is.
  void compute(int y) {
    const IntegralImage& integral = octave_.integral;
    for (int i = 0; i < intervals_; ++i) {
      const int reach = reach_px(i);
      if (y < reach || y >= integral.height - reach) continue;
      const auto side = static_cast<float>(3 * lobe_px(i) * octave_.step_px);
      kernels::kernels().hessian_row({.integral = integral.row(y),
                                      .stride = integral.stride,
                                      .lobe_px = lobe_px(i),
                                      .begin = reach,
                                      .end = integral.width - reach,
                                      .scale = 1 / (side * side),
                                      .scratch = scratch_.data(),
                                      .scratch_stride = stride_,
                                      .out = row(i, y)});
    }
  }
  [[nodiscard]] float* row(int interval, int y) { return values_.data() + (3 * interval + y % 3) * stride_; }

 private:
  const Octave& octave_;
  std::ptrdiff_t stride_;
  std::vector<std::uint32_t> scratch_;
  std::vector<float> values_;
  int intervals_;
};

struct Peak {
  double dx, dy, di;  // from the sample, in columns, rows and intervals
  double response;
};

/// The top of the quadratic through 3 x 3 x 3 responses; none if it is not near.
std::optional<Peak> refine(const float* const (&rows)[3][3], int x) {
  const auto at = [&](int di, int dy, int dx) { return static_cast<double>(rows[1 + di][1 + dy][x + dx]); };
  const double centre = at(0, 0, 0);
  const Eigen::Vector3d gradient{(at(0, 0, 1) - at(0, 0, -1)) / 2, (at(0, 1, 0) - at(0, -1, 0)) / 2,
                                 (at(1, 0, 0) - at(-1, 0, 0)) / 2};
  Eigen::Matrix3d hessian;
  hessian(0, 0) = at(0, 0, 1) + at(0, 0, -1) - 2 * centre;
  hessian(1, 1) = at(0, 1, 0) + at(0, -1, 0) - 2 * centre;
  hessian(2, 2) = at(1, 0, 0) + at(-1, 0, 0) - 2 * centre;
  hessian(0, 1) = hessian(1, 0) = (at(0, 1, 1) - at(0, 1, -1) - at(0, -1, 1) + at(0, -1, -1)) / 4;
  hessian(0, 2) = hessian(2, 0) = (at(1, 0, 1) - at(1, 0, -1) - at(-1, 0, 1) + at(-1, 0, -1)) / 4;
  hessian(1, 2) = hessian(2, 1) = (at(1, 1, 0) - at(1, -1, 0) - at(-1, 1, 0) + at(-1, -1, 0)) / 4;
  Eigen::Matrix3d inverse;
  bool invertible = false;
  hessian.computeInverseWithCheck(inverse, invertible);
  if (!invertible) return std::nullopt;
  const Eigen::Vector3d offset = -inverse * gradient;
  if (offset.cwiseAbs().maxCoeff() > 1) return std::nullopt;
  return Peak{offset.x(), offset.y(), offset.z(), centre + gradient.dot(offset) / 2};
}

/// +1 if the middle is darker than its surroundings.
std::int8_t laplacian_sign(const IntegralImage& integral, int interval, int x, int y) {
  const int l = lobe_px(interval), reach = reach_px(interval);
  const auto box = [&](int half_width, int half_height) {
    return static_cast<std::int64_t>(
        integral.box(x - half_width, y - half_height, x + half_width + 1, y + half_height + 1));
  };
  const std::int64_t dxx = box(reach, l - 1) - 3 * box((l - 1) / 2, l - 1);
  const std::int64_t dyy = box(l - 1, reach) - 3 * box(l - 1, (l - 1) / 2);
  return dxx + dyy >= 0 ? 1 : -1;
}

/// Adds the maxima of one row of an octave that are far enough from the rim of the image.
void find_maxima(const Octave& octave, const HessianOptions& options, Responses& responses, int y,
                 std::vector<int>& columns, std::vector<Feature>& found) {
  const IntegralImage& integral = octave.integral;
  const double step = octave.step_px;
  const double last_x = step * integral.width - 1, last_y = step * integral.height - 1;
  for (int i = 1; i + 1 < options.intervals; ++i) {
    const int margin = margin_px(i);
    if (y < margin || y >= integral.height - margin) continue;
    kernels::MaximaRow row{.begin = margin, .end = integral.width - margin, .threshold = options.threshold};
    for (int di = 0; di < 3; ++di) {
      for (int dy = 0; dy < 3; ++dy) row.rows[di][dy] = responses.row(i - 1 + di, y - 1 + dy);
    }
    const int count = kernels::kernels().maxima_row(row, columns.data());
    for (int k = 0; k < count; ++k) {
      const int column = columns[static_cast<std::size_t>(k)];
      const auto peak = refine(row.rows, column);
      if (!peak) continue;
      // Pixel (c, r) of the octave is the block of pixels whose centre is at step * (c, r) + (step - 1) / 2.
      const double x = step * (column + peak->dx) + (step - 1) / 2,
                   y_px = step * (y + peak->dy) + (step - 1) / 2;
      const double scale = step * kScalePerLobe * (lobe_px(i) + 2 * peak->di);
      const double rim = options.rim_scales * scale;
      if (std::min(x, y_px) < rim || x > last_x - rim || y_px > last_y - rim) continue;
      found.push_back({.x_px = static_cast<float>(x),
                       .y_px = static_cast<float>(y_px),
                       .scale_px = static_cast<float>(scale),
                       .response = static_cast<float>(peak->response),
                       .laplacian = laplacian_sign(integral, i, column, y)});
    }
  }
}

/// The maxima of rows [begin, end).
std::vector<Feature> maxima(const Octave& octave, const HessianOptions& options, int begin, int end) {
  std::vector<Feature> found;
  std::vector<int> columns(static_cast<std::size_t>(octave.integral.width));
  Responses responses(octave, options.intervals);
  responses.compute(begin - 1);
  responses.compute(begin);
  for (int y = begin; y < end; ++y) {
    responses.compute(y + 1);
    find_maxima(octave, options, responses, y, columns, found);
  }
  return found;
}

}  // namespace

bool HessianOptions::is_valid(std::string* error) const {
  const auto wrong = [&](const char* what) {
    if (error != nullptr) *error = what;
    return false;
  };
  if (!(threshold > 0)) return wrong("threshold must be > 0");
  if (octaves < 1 || octaves > 8) return wrong("octaves must be 1 to 8");
  if (intervals < 3 || intervals > 6) return wrong("intervals must be 3 to 6");
  if (!(rim_scales >= 0)) return wrong("rim_scales must be >= 0");
  if (initial_step_px != 1 && initial_step_px != 2 && initial_step_px != 4)
    return wrong("initial_step_px must be 1, 2 or 4");
  return true;
}

std::vector<Feature> detect_blobs(const IntegralImage& integral, const HessianOptions& options) {
  if (std::string error; !options.is_valid(&error)) throw std::invalid_argument("detect_blobs: " + error);
  struct Task {
    std::size_t octave;
    int begin, end;
  };
  std::deque<IntegralImage> shrunk;  // what octaves refer to stays where it is
  std::vector<Octave> octaves;
  std::vector<Task> tasks;
  const int margin = margin_px(1);
  for (int o = 0; o < options.octaves; ++o) {
    const int step_px = options.initial_step_px << o;
    if (std::min(integral.width, integral.height) / step_px <= 2 * margin) break;
    octaves.push_back({step_px == 1 ? integral : shrunk.emplace_back(coarser(integral, step_px)), step_px});
    const int end = octaves.back().integral.height - margin;
    for (int y = margin; y < end; y += kBandRows)
      tasks.push_back({octaves.size() - 1, y, std::min(y + kBandRows, end)});
  }
  std::vector<std::vector<Feature>> found(tasks.size());
  parallel_for(tasks.size(), [&](std::size_t t) {
    found[t] = maxima(octaves[tasks[t].octave], options, tasks[t].begin, tasks[t].end);
  });
  std::vector<Feature> points;
  for (const auto& part : found) points.insert(points.end(), part.begin(), part.end());
  const auto rank = [](const Feature& point) {
    return std::tuple(-point.response * std::sqrt(point.scale_px), point.y_px, point.x_px, point.scale_px);
  };
  const auto stronger = [&](const Feature& a, const Feature& b) { return rank(a) < rank(b); };
  const std::size_t kept =
      options.max_points == 0 ? points.size() : std::min(options.max_points, points.size());
  const auto weakest = points.begin() + static_cast<std::ptrdiff_t>(kept);
  std::nth_element(points.begin(), weakest, points.end(), stronger);
  points.erase(weakest, points.end());
  std::ranges::sort(points, stronger);
  return points;
}

}  // namespace vo
