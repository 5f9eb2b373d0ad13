#include "vo/surf/hessian_detector.hpp"

#include "kernels/kernels.hpp"
#include "vo/base/parallel.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <stdexcept>
#include <tuple>

#include <Eigen/Core>
#include <Eigen/LU>

namespace vo {
namespace {

constexpr int kBandRows = 24;  // of one task: its responses stay in the cache
constexpr int kMaxIntervals = 6;

/// Filter i of an octave, in the octave's pixels.
int lobe_px(int interval) {
  return 3 + 2 * interval;
}
int reach_px(int interval) {
  return (3 * lobe_px(interval) - 1) / 2;
}

struct Octave {
  IntegralImage integral;
  int step_px;
};

/// The responses of all intervals on a band of rows of an octave.
class Band {
 public:
  Band(const Octave& octave, int intervals, int begin, int end)
      : first_row_(begin - 1), rows_(end - begin + 2), stride_(octave.integral.width + kernels::kLanes) {
    responses_.resize(static_cast<std::size_t>(stride_ * rows_ * intervals) + kernels::kLanes);
    const IntegralImage& integral = octave.integral;
    std::vector<std::uint32_t> scratch(static_cast<std::size_t>(3 * (integral.stride + kernels::kLanes)));
    for (int i = 0; i < intervals; ++i) {
      const int reach = reach_px(i);
      const float side = static_cast<float>(3 * lobe_px(i) * octave.step_px);
      const int last = std::min(end + 1, integral.height - reach);
      for (int y = std::max(begin - 1, reach); y < last; ++y) {
        kernels::kernels().hessian_row({.integral = integral.row(y),
                                        .stride = integral.stride,
                                        .lobe_px = lobe_px(i),
                                        .begin = reach,
                                        .end = integral.width - reach,
                                        .scale = 1 / (side * side),
                                        .scratch = scratch.data(),
                                        .scratch_stride = integral.stride + kernels::kLanes,
                                        .out = row(i, y)});
      }
    }
  }

  [[nodiscard]] float* row(int interval, int y) {
    return responses_.data() + (interval * rows_ + y - first_row_) * stride_;
  }

 private:
  std::ptrdiff_t first_row_, rows_, stride_;
  std::vector<float> responses_;
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

std::vector<Feature> maxima(const Octave& octave, const HessianOptions& options, int begin, int end) {
  std::vector<Feature> found;
  const IntegralImage& integral = octave.integral;
  Band band(octave, options.intervals, begin, end);
  std::vector<int> columns(static_cast<std::size_t>(integral.width));
  for (int i = 1; i + 1 < options.intervals; ++i) {
    const int margin = reach_px(i + 1) + 1;
    for (int y = std::max(begin, margin); y < std::min(end, integral.height - margin); ++y) {
      kernels::MaximaRow row{.begin = margin, .end = integral.width - margin, .threshold = options.threshold};
      for (int di = 0; di < 3; ++di) {
        for (int dy = 0; dy < 3; ++dy) row.rows[di][dy] = band.row(i - 1 + di, y - 1 + dy);
      }
      const int count = kernels::kernels().maxima_row(row, columns.data());
      for (int k = 0; k < count; ++k) {
        const int x = columns[static_cast<std::size_t>(k)];
        const auto peak = refine(row.rows, x);
        if (!peak) continue;
        const double step = octave.step_px, lobe = lobe_px(i) + 2 * peak->di;
        found.push_back({.x_px = static_cast<float>(step * (x + peak->dx) + (step - 1) / 2),
                         .y_px = static_cast<float>(step * (y + peak->dy) + (step - 1) / 2),
                         .scale_px = static_cast<float>(step * 1.2 / 3 * lobe),
                         .response = static_cast<float>(peak->response),
                         .laplacian = laplacian_sign(integral, i, x, y)});
      }
    }
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
  if (intervals < 3 || intervals > kMaxIntervals) return wrong("intervals must be 3 to 6");
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
  std::vector<Octave> octaves;
  std::vector<Task> tasks;
  const int margin = reach_px(2) + 1;
  for (int o = 0; o < options.octaves; ++o) {
    const int step_px = options.initial_step_px << o;
    if (std::min(integral.width, integral.height) / step_px <= 2 * margin) break;
    octaves.push_back({coarser(integral, step_px), step_px});
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
  const auto stronger = [](const Feature& a, const Feature& b) {
    return std::tuple(-a.response, a.y_px, a.x_px, a.scale_px) <
           std::tuple(-b.response, b.y_px, b.x_px, b.scale_px);
  };
  const std::size_t kept =
      options.max_points == 0 ? points.size() : std::min(options.max_points, points.size());
  std::partial_sort(points.begin(), points.begin() + static_cast<std::ptrdiff_t>(kept), points.end(),
                    stronger);
  points.resize(kept);
  return points;
}

}  // namespace vo
