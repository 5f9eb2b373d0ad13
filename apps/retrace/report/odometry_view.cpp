#include "odometry_view.hpp"

#include "report/run_data.hpp"

#include <cmath>
#include <fstream>

#include <nlohmann/json.hpp>

#include <vo/base/degrees.hpp>
#include <vo/io/csv.hpp>
#include <vo/io/trajectory_io.hpp>

namespace retrace {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

std::vector<double> or_nan(const std::vector<std::optional<double>>& values) {
  std::vector<double> numbers;
  for (const std::optional<double>& value : values) numbers.push_back(value.value_or(NAN));
  return numbers;
}

template <typename T>
std::optional<T> number(const ordered_json& json, const char* name) {
  if (!json.contains(name) || !json[name].is_number()) return {};
  return json[name].get<T>();
}

OdometrySummary read_summary(const fs::path& path) {
  std::ifstream file(path);
  if (!file) return {};
  const ordered_json json = ordered_json::parse(file, nullptr, false);
  if (!json.is_object()) return {};
  OdometrySummary summary{.walk = json.value("walk", std::string{}),
                          .step_signal = json.value("step_signal", "orientation"),
                          .unit = json.value("unit", "m"),
                          .delta_min = number<double>(json, "delta_min"),
                          .distance = number<double>(json, "distance"),
                          .step_length_m = number<double>(json, "step_length_m"),
                          .duration_s = number<double>(json, "duration_s"),
                          .frames = number<std::int64_t>(json, "frames"),
                          .frames_bridged = number<std::int64_t>(json, "frames_bridged"),
                          .steps_bridged = number<std::int64_t>(json, "steps_bridged")};
  for (const auto& warning : json.value("warnings", ordered_json::array()))
    summary.warnings.push_back(warning.get<std::string>());
  return summary;
}

}  // namespace

OdometryView read_odometry(const fs::path& folder) {
  OdometryView walk;
  walk.trajectory = vo::read_tum(folder / "trajectory.tum");
  walk.summary = read_summary(folder / "summary.json");
  walk.alignment = read_run_data(folder).value("alignment", ordered_json::object());
  if (fs::exists(folder / "frames.csv")) {
    const vo::CsvTable table = vo::CsvTable::read(folder / "frames.csv");
    const auto alone = [&](const char* column) {
      return table.has(column) ? or_nan(table.optional_numbers(column))
                               : std::vector<double>(table.rows(), NAN);
    };
    walk.frames = {.time_s = table.numbers("time_s"),
                   .displacement = table.numbers("displacement"),
                   .orientation_deg = or_nan(table.optional_numbers("orientation_deg")),
                   .matches = table.numbers("matches"),
                   .heading_deg = table.numbers("heading_deg"),
                   .signal = table.numbers("step_signal"),
                   .threshold = table.numbers("step_threshold"),
                   .source = table.text("source"),
                   .reliable = table.indices("reliable"),
                   .vo_displacement = alone("vo_displacement"),
                   .sad_displacement = alone("sad_displacement"),
                   .vo_as_it_comes = alone("vo_as_it_comes")};
    std::vector<double> heading_rad;
    for (const double heading_deg : walk.frames.heading_deg)
      heading_rad.push_back(heading_deg * vo::kRadPerDeg);
    walk.turns = vo::find_turns(heading_rad, walk.frames.time_s);
  }
  if (fs::exists(folder / "steps.csv")) {
    const vo::CsvTable table = vo::CsvTable::read(folder / "steps.csv");
    walk.steps = {
        .time_s = table.numbers("time_s"),
        .frame = table.indices("frame"),
        .bridged = table.has("bridged") ? table.indices("bridged") : std::vector<std::int64_t>(table.rows()),
        .leg = table.text("leg")};
  }
  if (fs::exists(folder / "activity.csv")) {
    const vo::CsvTable table = vo::CsvTable::read(folder / "activity.csv");
    walk.activity = {.time_s = table.numbers("time_s"),
                     .amplitude_deg = table.numbers("amplitude_deg"),
                     .step_hz = table.numbers("step_hz"),
                     .activity = table.text("activity")};
  }
  return walk;
}

}  // namespace retrace
