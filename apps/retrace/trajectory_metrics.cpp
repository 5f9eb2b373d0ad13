#include "trajectory_metrics.hpp"

#include <fstream>
#include <optional>

#include <place/evaluation/trajectory_evaluation.hpp>
#include <vo/io/csv.hpp>
#include <vo/io/trajectory_io.hpp>

namespace retrace {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;
using place::TrajectoryAlignment;

/// The trajectory of a file; none if there is no file, or only a comment in it.
std::optional<vo::Trajectory> read_if_any(const fs::path& path) {
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);)
    if (!line.empty() && line.front() != '#') return vo::read_tum(path);
  return std::nullopt;
}

/// Among the poses with a true one, the share within the ellipse that should hold 90 % of them.
ordered_json share_inside_90(const fs::path& path, const vo::WalkTruth& truth) {
  if (!fs::exists(path)) return nullptr;
  constexpr double kNinety = 4.605170185988092;  // of chi-squared with two degrees of freedom: -2 ln 0.1
  const vo::CsvTable table = vo::CsvTable::read(path);
  const auto frame = table.indices("query_frame");
  const auto x_m = table.numbers("x_m"), y_m = table.numbers("y_m");
  const auto xx = table.numbers("cov_xx_m2"), xy = table.numbers("cov_xy_m2"),
             yy = table.numbers("cov_yy_m2");
  std::size_t inside = 0, all = 0;
  for (std::size_t i = 0; i < table.rows(); ++i) {
    const auto f = static_cast<std::size_t>(frame[i]);
    const double determinant = xx[i] * yy[i] - xy[i] * xy[i];
    if (f >= truth.pose.size() || !truth.pose[f] || !(determinant > 0)) continue;
    const double x = x_m[i] - truth.pose[f]->x_m, y = y_m[i] - truth.pose[f]->y_m;
    inside += (yy[i] * x * x - 2 * xy[i] * x * y + xx[i] * y * y) / determinant <= kNinety ? 1 : 0;
    ++all;
  }
  if (all == 0) return nullptr;
  return static_cast<double>(inside) / static_cast<double>(all);
}

}  // namespace

ordered_json trajectory_metrics(const fs::path& folder, const std::string& query_truth) {
  const vo::WalkTruth by_frame = vo::read_truth(query_truth);
  const vo::Trajectory truth = vo::poses_of(by_frame);
  ordered_json json;
  const auto evaluated = [&](const char* file, TrajectoryAlignment alignment) {
    std::optional<place::TrajectoryEvaluation> result;
    if (const auto estimate = read_if_any(folder / file)) {
      result = place::evaluate_trajectory(*estimate, truth, {.alignment = alignment});
      if (result->poses < 2) result.reset();
    }
    return result;
  };
  const auto as_is = evaluated("trajectory.tum", TrajectoryAlignment::kNone);
  const auto aligned = evaluated("trajectory.tum", TrajectoryAlignment::kRigid);
  const auto odometry = evaluated("trajectory_odometry.tum", TrajectoryAlignment::kNone);
  const auto of = [](const auto& evaluation, const auto& value) {
    return evaluation ? ordered_json(value(*evaluation)) : ordered_json(nullptr);
  };
  using Evaluation = place::TrajectoryEvaluation;
  const auto rmse = [](const Evaluation& e) { return e.ape_m.rmse; };
  const auto end = [](const Evaluation& e) { return e.end_error_m; };
  json["ape_poses"] = of(as_is, [](const Evaluation& e) { return e.poses; });
  json["ape_rmse_m"] = of(as_is, rmse);
  json["ape_mean_m"] = of(as_is, [](const Evaluation& e) { return e.ape_m.mean; });
  json["ape_median_m"] = of(as_is, [](const Evaluation& e) { return e.ape_m.median; });
  json["ape_max_m"] = of(as_is, [](const Evaluation& e) { return e.ape_m.max; });
  json["ape_end_m"] = of(as_is, end);
  json["ape_aligned_rmse_m"] = of(aligned, rmse);
  json["rpe_rmse_m"] = of(as_is, [](const Evaluation& e) { return e.rpe_m.rmse; });
  json["rpe_mean_m"] = of(as_is, [](const Evaluation& e) { return e.rpe_m.mean; });
  json["ape_odometry_rmse_m"] = of(odometry, rmse);
  json["ape_odometry_end_m"] = of(odometry, end);
  json["ape_inside_90"] = share_inside_90(folder / "trajectory.csv", by_frame);
  return json;
}

}  // namespace retrace
