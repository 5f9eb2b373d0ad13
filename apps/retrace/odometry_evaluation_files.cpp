#include "odometry_evaluation_files.hpp"

#include <filesystem>
#include <string_view>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <vo/base/error.hpp>
#include <vo/io/csv.hpp>

namespace retrace {
namespace {

using nlohmann::ordered_json;

constexpr std::string_view kProtocol =
    "Random segments, at whose start the trajectory is put at the true place and heading; errors at "
    "distances truly travelled from there; mean and standard deviation over all measurements of all walks "
    "(PVO "
    "5.2, 5.4). Heading errors are truth minus estimate, clockwise: positive where the estimate drifts to "
    "the "
    "left, as in PVO.";

std::vector<place::MapPoint> read_map_path(const vo::CsvTable& table, const std::string& path,
                                           double scale_m_per_px) {
  const std::vector<double> x_px = table.numbers("x_px");
  const std::vector<double> y_px = table.numbers("y_px");
  std::vector<place::MapPoint> map_path;
  bool moves = false;
  for (std::size_t i = 0; i < table.rows(); ++i) {
    map_path.push_back({x_px[i] * scale_m_per_px, -y_px[i] * scale_m_per_px});  // down on the map is south
    moves = moves || x_px[i] != x_px[0] || y_px[i] != y_px[0];
  }
  if (!moves) throw vo::Error(path, "is no path", "two points or more of different places");
  return map_path;
}

std::size_t true_steps(const std::vector<place::StepCount>& walks) {
  std::size_t steps = 0;
  for (const place::StepCount& walk : walks) steps += walk.truth;
  return steps;
}

}  // namespace

WalkTruth read_walk_truth(const std::string& path, const std::optional<double>& map_scale_m_per_px,
                          const std::optional<std::size_t>& counted_steps) {
  const vo::CsvTable table = vo::CsvTable::read(path);
  WalkTruth truth;
  if (table.has("x_px")) {
    if (!map_scale_m_per_px)
      throw vo::Error(path, "is a path on a map", "--map-scale-m-per-px, the metres of one of its pixels");
    truth.map_path = read_map_path(table, path, *map_scale_m_per_px);
  } else {
    if (map_scale_m_per_px)
      throw vo::Error(path, "has no column 'x_px'", "a path on a map, with --map-scale-m-per-px");
    const vo::WalkTruth walk = vo::read_truth(path);
    truth.walk = vo::poses_along_route(walk);
    if (const auto steps = vo::steps_in_all(walk)) truth.steps = static_cast<std::size_t>(*steps);
  }
  if (counted_steps) truth.steps = counted_steps;
  return truth;
}

OdometryMeasured pooled(const std::vector<OdometryMeasured>& walks) {
  OdometryMeasured all{.walks = 0};
  std::vector<place::OdometryEvaluation> evaluations;
  for (const OdometryMeasured& walk : walks) {
    all.walks += walk.walks;
    all.steps += walk.steps;
    all.counted.insert(all.counted.end(), walk.counted.begin(), walk.counted.end());
    evaluations.push_back(walk.evaluation);
  }
  all.evaluation = place::pooled(evaluations);
  return all;
}

ordered_json odometry_metrics_json(const OdometryMeasured& measured,
                                   const place::OdometryEvaluationOptions& options) {
  const place::OdometryEvaluation& evaluation = measured.evaluation;
  ordered_json json{{"walks", measured.walks},
                    {"steps_estimated", measured.steps},
                    {"steps_true", nullptr},
                    {"step_error_pct", nullptr},
                    {"distance_m", evaluation.distance_m},
                    {"segments", options.segments},
                    {"segment_m", evaluation.segment_m},
                    {"seed", options.seed}};
  if (measured.counted.size() == measured.walks) json["steps_true"] = true_steps(measured.counted);
  if (true_steps(measured.counted) > 0) {
    const place::StepErrors errors = place::step_errors(measured.counted);
    json["step_error_pct"] = errors.pct;
    json["step_error"] = {{"walks", measured.counted.size()},
                          {"absolute_mean", errors.absolute_mean},
                          {"absolute_sd", errors.absolute_sd},
                          {"mean", errors.mean},
                          {"sd", errors.sd}};
  }
  const auto add = [&](const char* name, double place::OdometryErrors::*value) {
    for (const place::OdometryErrors& errors : evaluation.errors)
      json[name][fmt::format("{}", errors.at_m)] = errors.count > 0 ? ordered_json(errors.*value) : nullptr;
  };
  add("euclidean_error_m", &place::OdometryErrors::euclidean_mean_m);
  add("euclidean_error_sd_m", &place::OdometryErrors::euclidean_sd_m);
  add("heading_error_deg", &place::OdometryErrors::heading_mean_deg);
  add("heading_error_sd_deg", &place::OdometryErrors::heading_sd_deg);
  add("heading_absolute_error_deg", &place::OdometryErrors::heading_abs_mean_deg);
  for (const place::OdometryErrors& errors : evaluation.errors)
    json["measurements"][fmt::format("{}", errors.at_m)] = errors.count;
  json["protocol"] = kProtocol;
  return json;
}

void check_metres(const std::filesystem::path& folder) {
  if (!std::filesystem::exists(folder / "frames.csv")) return;
  const vo::CsvTable frames = vo::CsvTable::read(folder / "frames.csv");
  if (frames.rows() == 0 || !frames.has("unit")) return;
  const std::string unit = frames.text("unit").front();
  if (unit == "m") return;
  throw vo::Error((folder / "trajectory.tum").string(), fmt::format("is in '{}', no metres", unit),
                  "a walk whose steps were seen, or that was given --camera-height-m");
}

void print_odometry_metrics(const OdometryMeasured& measured) {
  const place::OdometryEvaluation& evaluation = measured.evaluation;
  if (measured.walks > 1) fmt::print("{} walks, ", measured.walks);
  fmt::print("steps: {}", measured.steps);
  if (measured.counted.size() == measured.walks) fmt::print(", truly {}", true_steps(measured.counted));
  if (true_steps(measured.counted) > 0) {
    const place::StepErrors errors = place::step_errors(measured.counted);
    fmt::print(", error {:.2f} %", errors.pct);
    if (measured.counted.size() > 1)
      fmt::print(", {:.2f} +- {:.2f} steps a walk", errors.absolute_mean, errors.absolute_sd);
  }
  fmt::print("\n{:>7} {:>12} {:>16} {:>18}\n", "at m", "measurements", "position m", "heading deg");
  for (const place::OdometryErrors& errors : evaluation.errors) {
    if (errors.count == 0) continue;
    fmt::print("{:>7} {:>12} {:>16} {:>18}\n", errors.at_m, errors.count,
               fmt::format("{:.2f} +- {:.2f}", errors.euclidean_mean_m, errors.euclidean_sd_m),
               fmt::format("{:.2f} +- {:.2f}", errors.heading_mean_deg, errors.heading_sd_deg));
  }
}

}  // namespace retrace
