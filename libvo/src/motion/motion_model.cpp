#include "vo/motion/motion_model.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

#include <unsupported/Eigen/Splines>

namespace vo {
namespace {

using Spline = Eigen::Spline<double, 1>;

/// The spline through the knots, over errors scaled to [0, 1].
Spline fit(const MotionModel& model) {
  const auto count = static_cast<Eigen::Index>(model.error.size());
  const Eigen::RowVectorXd separations = Eigen::Map<const Eigen::RowVectorXd>(model.separation.data(), count);
  const Eigen::RowVectorXd errors =
      Eigen::Map<const Eigen::RowVectorXd>(model.error.data(), count) / model.error.back();
  const Eigen::Index degree = std::min<Eigen::Index>(2, count - 1);
  return Eigen::SplineFitting<Spline>::Interpolate(separations, degree, errors);
}

/// Separations on an even grid of errors, from the spline or, where it is not increasing, straight between
/// the knots. Fine enough that reading between its points is exact to 1e-5 frames.
class Curve {
 public:
  explicit Curve(const MotionModel& model) : step_(model.error.back() / kSteps) {
    const Spline spline = fit(model);
    for (int i = 0; i <= kSteps; ++i) value_[i] = spline(static_cast<double>(i) / kSteps)(0);
    if (!std::ranges::is_sorted(value_)) {
      for (int i = 0; i <= kSteps; ++i) value_[i] = straight(model, i * step_);
    }
  }

  [[nodiscard]] double operator()(double error) const {
    const double position = std::clamp(error / step_, 0.0, static_cast<double>(kSteps));
    const int low = std::min(static_cast<int>(position), kSteps - 1);
    return std::max(0.0, std::lerp(value_[low], value_[low + 1], position - low));
  }

 private:
  static constexpr int kSteps = 4096;

  static double straight(const MotionModel& model, double error) {
    const auto after = std::ranges::lower_bound(model.error, error);
    if (after == model.error.begin()) return model.separation.front();
    if (after == model.error.end()) return model.separation.back();
    const auto i = static_cast<std::size_t>(after - model.error.begin());
    const double t = (error - model.error[i - 1]) / (model.error[i] - model.error[i - 1]);
    return std::lerp(model.separation[i - 1], model.separation[i], t);
  }

  double step_;
  std::array<double, kSteps + 1> value_;
};

/// estimates[k - 1][i]: speed from frames i and i + k; infinite where there is none to be had.
using SpeedEstimates = std::vector<std::vector<double>>;

SpeedEstimates empty_estimates(const AlignmentErrors& errors, int separations) {
  if (separations < 1 || separations > errors.max_separation()) {
    throw std::invalid_argument("estimate_motion: separations must be in 1 .. max_separation");
  }
  SpeedEstimates estimates(static_cast<std::size_t>(separations));
  for (std::size_t k = 1; k <= estimates.size(); ++k) estimates[k - 1].resize(errors.by_separation[k].size());
  return estimates;
}

void estimate_speeds(const AlignmentErrors& errors, const MotionModel& model, std::size_t begin,
                     std::size_t end, SpeedEstimates& estimates) {
  const Curve curve(model);
  for (std::size_t k = 1; k <= estimates.size(); ++k) {
    const std::vector<float>& error = errors.by_separation[k];
    for (std::size_t i = begin; i < std::min(end, error.size()); ++i) {
      const bool clamped = error[i] >= model.error.back();
      estimates[k - 1][i] = k > 1 && clamped ? std::numeric_limits<double>::infinity()
                                             : curve(error[i]) / static_cast<double>(k);
    }
  }
}

/// The least over k of the mean estimate of the spans that contain the step from frame j to j + 1.
double least_speed(const SpeedEstimates& estimates, std::size_t j) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 1; k <= estimates.size(); ++k) {
    const std::vector<double>& speeds = estimates[k - 1];
    if (speeds.empty()) break;
    const std::size_t first = j + 1 >= k ? j + 1 - k : 0;
    const std::size_t last = std::min(j, speeds.size() - 1);
    double sum = 0;
    for (std::size_t i = first; i <= last; ++i) sum += speeds[i];
    if (first <= last) least = std::min(least, sum / static_cast<double>(last - first + 1));
  }
  return least;
}

std::vector<double> least_speeds(const SpeedEstimates& estimates, std::size_t frames,
                                 double max_displacement) {
  std::vector<double> displacement(frames, 0.0);
  for (std::size_t j = 0; j + 1 < frames; ++j)
    displacement[j + 1] = std::min(max_displacement, least_speed(estimates, j));
  return displacement;
}

/// Mean errors over frames [begin, end) only.
std::vector<double> mean_errors_within(const AlignmentErrors& errors, std::vector<bool> excluded,
                                       std::size_t begin, std::size_t end) {
  excluded.resize(errors.frames(), false);
  for (std::size_t i = 0; i < excluded.size(); ++i) {
    if (i < begin || i >= end) excluded[i] = true;
  }
  return mean_error_by_separation(errors, excluded);
}

}  // namespace

MotionModel learn_motion_model(std::span<const double> mean_error_by_separation) {
  MotionModel model{.error = {0}, .separation = {0}};
  for (std::size_t s = 1; s < mean_error_by_separation.size(); ++s) {
    if (!(mean_error_by_separation[s] > model.error.back())) break;
    model.error.push_back(mean_error_by_separation[s]);
    model.separation.push_back(static_cast<double>(s));
  }
  return model;
}

std::vector<double> separation_of(const MotionModel& model, std::span<const float> errors) {
  std::vector<double> separations(errors.size(), 0.0);
  if (!model.learned()) return separations;
  const Curve curve(model);
  std::ranges::transform(errors, separations.begin(), curve);
  return separations;
}

MotionModel learn_motion_model(const AlignmentErrors& errors, std::span<const double> displacement,
                               const std::vector<bool>& known) {
  if (displacement.size() != errors.frames() || known.size() != errors.frames())
    throw std::invalid_argument("learn_motion_model: one displacement and one flag per frame expected");
  MotionModel model{.error = {0}, .separation = {0}};
  struct Pair {
    double displacement, error;
  };
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i + 1 < known.size(); ++i) {
    double travelled = 0;
    for (std::size_t s = 1; s < errors.by_separation.size() && i + s < known.size() && known[i + s]; ++s) {
      travelled += displacement[i + s];
      pairs.push_back({travelled, errors.by_separation[s][i]});
    }
  }
  if (pairs.size() < 10 * kMotionModelBins) return model;
  std::ranges::stable_sort(pairs, {}, &Pair::displacement);
  for (std::size_t bin = 0; bin < kMotionModelBins; ++bin) {
    const std::size_t begin = pairs.size() * bin / kMotionModelBins;
    const std::size_t end = pairs.size() * (bin + 1) / kMotionModelBins;
    Pair mean{0, 0};
    for (std::size_t i = begin; i < end; ++i) {
      mean.displacement += pairs[i].displacement / static_cast<double>(end - begin);
      mean.error += pairs[i].error / static_cast<double>(end - begin);
    }
    if (!(mean.displacement > model.separation.back())) continue;  // standing
    if (!(mean.error > model.error.back())) break;                 // saturated
    model.error.push_back(mean.error);
    model.separation.push_back(mean.displacement);
  }
  return model;
}

std::vector<double> apply_motion_model(const AlignmentErrors& errors, const MotionModel& model,
                                       int separations, double max_displacement) {
  if (!(max_displacement > 0))
    throw std::invalid_argument("apply_motion_model: max_displacement must be positive");
  SpeedEstimates estimates = empty_estimates(errors, separations);
  if (!model.learned()) return std::vector<double>(errors.frames(), 0.0);
  estimate_speeds(errors, model, 0, errors.frames(), estimates);
  return least_speeds(estimates, errors.frames(), max_displacement);
}

std::vector<double> estimate_motion(const AlignmentErrors& errors, const std::vector<bool>& excluded,
                                    std::span<const double> time_s, const MotionModelOptions& options) {
  if (!(options.max_speed > 0)) throw std::invalid_argument("estimate_motion: max_speed must be positive");
  SpeedEstimates estimates = empty_estimates(errors, options.separations);
  const std::size_t frames = errors.frames();
  if (frames < 2) return std::vector<double>(frames, 0.0);
  if (options.local_window_s <= 0) {
    const MotionModel model = learn_motion_model(mean_error_by_separation(errors, excluded));
    return apply_motion_model(errors, model, options.separations, options.max_speed);
  }
  if (time_s.size() != frames) throw std::invalid_argument("estimate_motion: one time per frame expected");
  // A new model every quarter of a window, learned from the window that ends there; the first one serves
  // until then.
  const double hop_s = options.local_window_s / 4;
  std::size_t begin = 0;
  for (double end_s = options.local_window_s;; end_s += hop_s) {
    const auto frame_at = [&](double s) {
      return static_cast<std::size_t>(std::ranges::lower_bound(time_s, s) - time_s.begin());
    };
    const std::size_t end = frame_at(end_s);
    const std::size_t first = frame_at(end_s - options.local_window_s);
    const MotionModel model = learn_motion_model(mean_errors_within(errors, excluded, first, end));
    if (model.learned()) estimate_speeds(errors, model, begin, end, estimates);
    if (end >= frames) break;
    begin = end;
  }
  return least_speeds(estimates, frames, options.max_speed);
}

}  // namespace vo
