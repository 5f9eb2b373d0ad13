#include "odometry_view.hpp"

#include "json_file.hpp"
#include "report/run_data.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <vo/base/degrees.hpp>
#include <vo/base/error.hpp>
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

OdometrySummary read_summary(const fs::path& path) {
  const ordered_json json = read_json_object(path);
  return {.walk = text_in(json, "walk").value_or(""),
          .step_signal = text_in(json, "step_signal").value_or("orientation"),
          .unit = text_in(json, "unit").value_or("m"),
          .delta_min = number_in(json, "delta_min"),
          .distance = number_in(json, "distance"),
          .step_length_m = number_in(json, "step_length_m"),
          .duration_s = number_in(json, "duration_s"),
          .frames = count_in(json, "frames"),
          .frames_bridged = count_in(json, "frames_bridged"),
          .steps_bridged = count_in(json, "steps_bridged"),
          .warnings = texts_in(json, "warnings")};
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
    const std::vector<double> time_s = table.numbers("time_s");
    const auto back = std::ranges::is_sorted_until(time_s);
    if (back != time_s.end())
      throw vo::Error(table.where(static_cast<std::size_t>(back - time_s.begin())),
                      fmt::format("has the time {} s after {} s", *back, *std::prev(back)),
                      "frames in order");
    walk.frames = {.time_s = time_s,
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
