#include "place/evaluation/kitti_evaluation.hpp"

#include <algorithm>
#include <numbers>
#include <numeric>
#include <stdexcept>

namespace place {
namespace {

/// The true distance travelled at each frame.
std::vector<double> travelled_m(std::span<const vo::Pose3> truth) {
  std::vector<double> distance_m(truth.size(), 0);
  for (std::size_t i = 1; i < truth.size(); ++i)
    distance_m[i] = distance_m[i - 1] + cv::norm(truth[i].position - truth[i - 1].position);
  return distance_m;
}

void check(std::span<const vo::Pose3> truth, std::span<const std::optional<vo::Pose3>> estimate) {
  if (truth.size() != estimate.size())
    throw std::invalid_argument("evaluate_kitti: a true pose for each frame of the estimate expected");
}

void add(KittiErrors& errors, double translation_pct, double rotation_deg_per_m) {
  ++errors.stretches;
  const auto count = static_cast<double>(errors.stretches);
  errors.translation_pct += (translation_pct - errors.translation_pct) / count;
  errors.rotation_deg_per_m += (rotation_deg_per_m - errors.rotation_deg_per_m) / count;
}

}  // namespace

KittiEvaluation evaluate_kitti(std::span<const vo::Pose3> truth,
                               std::span<const std::optional<vo::Pose3>> estimate,
                               const KittiEvaluationOptions& options) {
  check(truth, estimate);
  if (options.every < 1 || std::ranges::any_of(options.lengths_m, [](double m) { return !(m > 0); }))
    throw std::invalid_argument("evaluate_kitti: lengths above 0 and every >= 1 expected");
  const std::vector<double> distance_m = travelled_m(truth);
  KittiEvaluation result;
  for (const double length_m : options.lengths_m) {
    KittiErrors& errors = result.by_length.emplace_back();
    errors.length_m = length_m;
    for (std::size_t first = 0; first < truth.size(); first += options.every) {
      const auto beyond = std::ranges::upper_bound(distance_m, distance_m[first] + length_m);
      if (beyond == distance_m.end()) break;
      const auto last = static_cast<std::size_t>(beyond - distance_m.begin());
      if (!estimate[first] || !estimate[last]) {
        ++result.unknown;
        continue;
      }
      const vo::Pose3 off =
          vo::compose(vo::inverse(vo::compose(vo::inverse(*estimate[first]), *estimate[last])),
                      vo::compose(vo::inverse(truth[first]), truth[last]));
      const double translation_pct = 100 * cv::norm(off.position) / length_m;
      const double rotation_deg_per_m = vo::angle_rad(off.rotation) * 180 / std::numbers::pi / length_m;
      add(errors, translation_pct, rotation_deg_per_m);
      add(result.all, translation_pct, rotation_deg_per_m);
    }
  }
  return result;
}

std::optional<double> metres_per_unit(std::span<const vo::Pose3> truth,
                                      std::span<const std::optional<vo::Pose3>> estimate, double length_m) {
  check(truth, estimate);
  double true_m = 0, estimated = 0;
  const auto first = static_cast<std::size_t>(
      std::ranges::find_if(estimate, [](const auto& pose) { return pose.has_value(); }) - estimate.begin());
  for (std::size_t i = first + 1; i < truth.size() && true_m < length_m; ++i) {
    if (!estimate[i]) return std::nullopt;
    true_m += cv::norm(truth[i].position - truth[i - 1].position);
    estimated += cv::norm(estimate[i]->position - estimate[i - 1]->position);
  }
  if (!(estimated > 0)) return std::nullopt;
  return true_m / estimated;
}

}  // namespace place
