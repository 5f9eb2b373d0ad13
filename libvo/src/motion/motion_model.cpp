#include "vo/motion/motion_model.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

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

constexpr int kCurveSteps = 4096;  // interpolating between them is exact to 1e-5 frames

double straight(const MotionModel& model, double error) {
  const auto after = std::ranges::lower_bound(model.error, error);
  if (after == model.error.begin()) return model.separation.front();
  if (after == model.error.end()) return model.separation.back();
  const auto i = static_cast<std::size_t>(after - model.error.begin());
  const double t = (error - model.error[i - 1]) / (model.error[i] - model.error[i - 1]);
  return std::lerp(model.separation[i - 1], model.separation[i], t);
}

/// estimates[k][i]: speed from frame i on, over k + 1 spans; infinite where there is none.
using SpeedEstimates = std::vector<std::vector<double>>;

constexpr double kNoSpeed = std::numeric_limits<double>::infinity();

SpeedEstimates empty_estimates(const AlignmentErrors& errors, std::span<const double> time_s,
                               int separations) {
  if (separations < 1 || static_cast<std::size_t>(separations) > errors.spans())
    throw std::invalid_argument("estimate_motion: separations must be in 1 .. the number of spans");
  if (time_s.size() != errors.frames())
    throw std::invalid_argument("estimate_motion: one time per frame expected");
  // With few frames a second, neighbours are compared over a later span; the first in use always counts.
  const auto used = std::ranges::find_if(
      errors.by_span, [](const auto& span) { return std::ranges::any_of(span, &Comparison::made); });
  const std::size_t first =
      used == errors.by_span.end() ? 1 : static_cast<std::size_t>(used - errors.by_span.begin()) + 1;
  return SpeedEstimates(std::max(static_cast<std::size_t>(separations), first),
                        std::vector<double>(errors.frames(), kNoSpeed));
}

void estimate_speeds(const AlignmentErrors& errors, const MotionModel& model, std::size_t begin,
                     std::size_t end, SpeedEstimates& estimates) {
  const SeparationCurve curve(model);
  for (std::size_t k = 0; k < estimates.size(); ++k) {
    for (std::size_t i = begin; i < std::min(end, errors.frames()); ++i) {
      const Comparison& compared = errors.by_span[k][i];
      if (!compared.made()) continue;
      const bool shortest = k == 0 || compared.frames == 1;
      if (shortest || compared.error < model.error.back())
        estimates[k][i] = curve(compared.error) / compared.seconds;
    }
  }
}

/// At each frame the least over k of the mean estimate of the spans that contain the step to it; infinite
/// where none contains it.
std::vector<double> least_speeds(const AlignmentErrors& errors, const SpeedEstimates& estimates) {
  const std::size_t frames = errors.frames();
  std::vector<double> least(frames, kNoSpeed);
  for (std::size_t k = 0; k < estimates.size(); ++k) {
    std::vector<double> sum(frames, 0), count(frames, 0);
    for (std::size_t i = 0; i < frames; ++i) {
      for (std::size_t j = i + 1; j <= i + errors.by_span[k][i].frames; ++j) {
        sum[j] += estimates[k][i];
        ++count[j];
      }
    }
    for (std::size_t j = 0; j < frames; ++j)
      if (count[j] > 0) least[j] = std::min(least[j], sum[j] / count[j]);
  }
  return least;
}

std::vector<std::optional<double>> displacements(const AlignmentErrors& errors,
                                                 const SpeedEstimates& estimates,
                                                 std::span<const double> time_s, double max_speed) {
  const std::vector<double> speed = least_speeds(errors, estimates);
  std::vector<std::optional<double>> displacement(speed.size());
  if (!displacement.empty()) displacement[0] = 0;
  for (std::size_t i = 1; i < speed.size(); ++i)
    if (speed[i] < kNoSpeed) displacement[i] = std::min(max_speed, speed[i]) * (time_s[i] - time_s[i - 1]);
  return displacement;
}

/// Mean errors over frames [begin, end) only.
MeanErrors mean_errors_within(const AlignmentErrors& errors, std::vector<bool> excluded, std::size_t begin,
                              std::size_t end) {
  excluded.resize(errors.frames(), false);
  for (std::size_t i = 0; i < excluded.size(); ++i) {
    if (i < begin || i >= end) excluded[i] = true;
  }
  return mean_errors(errors, excluded);
}

std::vector<double> or_zero(const std::vector<std::optional<double>>& values) {
  std::vector<double> numbers;
  for (const std::optional<double>& value : values) numbers.push_back(value.value_or(0));
  return numbers;
}

}  // namespace

MotionModel learn_motion_model(const MeanErrors& means) {
  MotionModel model{.error = {0}, .separation = {0}};
  for (std::size_t k = 1; k < means.error.size(); ++k) {
    if (!(means.error[k] > model.error.back())) break;
    model.error.push_back(means.error[k]);
    model.separation.push_back(means.seconds[k]);
  }
  return model;
}

SeparationCurve::SeparationCurve(const MotionModel& model) {
  if (!model.learned()) return;
  step_ = model.error.back() / kCurveSteps;
  const Spline spline = fit(model);
  for (int i = 0; i <= kCurveSteps; ++i) value_.push_back(spline(static_cast<double>(i) / kCurveSteps)(0));
  if (std::ranges::is_sorted(value_)) return;
  for (int i = 0; i <= kCurveSteps; ++i) value_[static_cast<std::size_t>(i)] = straight(model, i * step_);
}

double SeparationCurve::operator()(double error) const {
  if (value_.empty()) return 0;
  const double position = std::clamp(error / step_, 0.0, static_cast<double>(kCurveSteps));
  const auto low = static_cast<std::size_t>(std::min(static_cast<int>(position), kCurveSteps - 1));
  return std::max(0.0, std::lerp(value_[low], value_[low + 1], position - static_cast<double>(low)));
}

std::vector<double> separation_of(const MotionModel& model, std::span<const float> errors) {
  std::vector<double> separations(errors.size());
  std::ranges::transform(errors, separations.begin(), SeparationCurve(model));
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
  std::vector<double> travelled{0};     // up to each frame
  std::vector<std::size_t> unknown{0};  // how many unknown frames, up to each
  for (std::size_t i = 0; i < known.size(); ++i) {
    travelled.push_back(travelled.back() + (known[i] ? displacement[i] : 0));
    unknown.push_back(unknown.back() + (known[i] ? 0 : 1));
  }
  for (std::size_t i = 0; i < known.size(); ++i) {
    for (const auto& comparisons : errors.by_span) {
      const std::size_t later = i + comparisons[i].frames;
      if (later == i || unknown[later + 1] > unknown[i + 1]) continue;
      pairs.push_back({travelled[later + 1] - travelled[i + 1], comparisons[i].error});
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

std::vector<std::optional<double>> apply_motion_model(const AlignmentErrors& errors, const MotionModel& model,
                                                      std::span<const double> time_s, int separations,
                                                      double max_speed) {
  if (!(max_speed > 0)) throw std::invalid_argument("apply_motion_model: max_speed must be positive");
  SpeedEstimates estimates = empty_estimates(errors, time_s, separations);
  if (!model.learned()) return std::vector<std::optional<double>>(errors.frames(), 0.0);
  estimate_speeds(errors, model, 0, errors.frames(), estimates);
  return displacements(errors, estimates, time_s, max_speed);
}

std::vector<double> estimate_motion(const AlignmentErrors& errors, const std::vector<bool>& excluded,
                                    std::span<const double> time_s, const MotionModelOptions& options) {
  if (!(options.max_speed > 0)) throw std::invalid_argument("estimate_motion: max_speed must be positive");
  SpeedEstimates estimates = empty_estimates(errors, time_s, options.separations);
  const std::size_t frames = errors.frames();
  if (frames < 2) return std::vector<double>(frames, 0.0);
  if (options.local_window_s <= 0) {
    const MotionModel model = learn_motion_model(mean_errors(errors, excluded));
    return or_zero(apply_motion_model(errors, model, time_s, options.separations, options.max_speed));
  }
  // A new model every quarter of a window, learned from the window that ends there; the first one serves
  // until then.
  const double hop_s = options.local_window_s / 4;
  std::size_t begin = 0;
  MotionModel model;
  for (double end_s = time_s[0] + options.local_window_s;; end_s += hop_s) {
    const auto frame_at = [&](double s) {
      return static_cast<std::size_t>(std::ranges::lower_bound(time_s, s) - time_s.begin());
    };
    const std::size_t end = frame_at(end_s);
    const std::size_t first = frame_at(end_s - options.local_window_s);
    MotionModel learned = learn_motion_model(mean_errors_within(errors, excluded, first, end));
    if (learned.learned()) model = std::move(learned);  // else the one before goes on
    if (model.learned()) estimate_speeds(errors, model, begin, end, estimates);
    if (end >= frames) break;
    begin = end;
  }
  return or_zero(displacements(errors, estimates, time_s, options.max_speed));
}

}  // namespace vo
