#include "odometry_report.hpp"

#include "report/alignment_figures.hpp"
#include "report/odometry_charts.hpp"
#include "report/page.hpp"
#include "report/position_charts.hpp"
#include "report/settings_table.hpp"

#include <fmt/format.h>

namespace retrace {
namespace {

void put_headlines(Page& page, const OdometryView& walk) {
  const OdometrySummary& summary = walk.summary;
  std::vector<Headline> numbers{
      {"Steps", std::to_string(walk.steps.time_s.size()),
       summary.steps_bridged ? fmt::format("of them {} bridged", *summary.steps_bridged) : ""}};
  if (walk.truth != nullptr && !walk.truth->steps.empty())
    numbers.push_back({"True steps", walk.truth->steps, ""});
  if (summary.distance) {
    numbers.push_back({"Distance", fmt::format("{:.1f} {}", *summary.distance, summary.unit),
                       summary.unit == "m" && summary.step_length_m
                           ? fmt::format("steps of {:.3f} m on average", *summary.step_length_m)
                           : "not known in metres"});
  }
  if (summary.duration_s) {
    numbers.push_back({"Duration", fmt::format("{:.1f} s", *summary.duration_s),
                       fmt::format("{} frames", summary.frames.value_or(0))});
  }
  if (summary.frames_bridged)
    numbers.push_back({"Bridged", std::to_string(*summary.frames_bridged), "frames with too few matches"});
  if (!walk.frames.time_s.empty())
    numbers.push_back({"Turns", std::to_string(walk.turns.size()), "of 30 degrees or more"});
  if (walk.truth != nullptr) {
    for (const place::OdometryErrors& errors : walk.truth->evaluation.errors) {
      if (errors.count == 0 || (errors.at_m != 10 && errors.at_m != 50 && errors.at_m != 100)) continue;
      numbers.push_back({fmt::format("Error after {:g} m", errors.at_m),
                         fmt::format("{:.2f} m", errors.euclidean_mean_m),
                         fmt::format("heading {:+.1f} deg", errors.heading_mean_deg)});
    }
  }
  page.headlines(numbers);
  for (const std::string& warning : summary.warnings) page.warning(warning);
}

void put_errors(Page& page, const OdometryView& walk) {
  if (walk.truth == nullptr) return;
  page.heading("Error against distance");
  page.chart("", position_error_chart(walk),
             "Random segments, at whose start the trajectory is put at the true place and heading [PVO 5.2, "
             "Fig. 7].");
  page.chart("", heading_error_chart(walk),
             "Positive where the trajectory drifts to the left, as in PVO 5.4.");
  std::vector<std::vector<std::string>> rows;
  for (const place::OdometryErrors& e : walk.truth->evaluation.errors) {
    if (e.count == 0) continue;
    rows.push_back({fmt::format("{:g}", e.at_m), std::to_string(e.count),
                    fmt::format("{:.2f}", e.euclidean_mean_m), fmt::format("{:.2f}", e.euclidean_sd_m),
                    fmt::format("{:.2f}", e.heading_mean_deg), fmt::format("{:.2f}", e.heading_sd_deg)});
  }
  page.table({"at, m", "segments", "position, m", "sd", "heading, deg", "sd"}, rows);
}

}  // namespace

std::string odometry_report(const std::filesystem::path& folder, const OdometryTruth* truth) {
  OdometryView walk = read_odometry(folder);
  walk.truth = truth;
  Page page("Steps and trajectory", walk.summary.walk.empty() ? folder.string() : walk.summary.walk);
  put_headlines(page, walk);
  page.chart("Trajectory", trajectory_chart(walk),
             truth == nullptr
                 ? "From the first frame, which looks along y. The square is the start."
                 : "Metres. The odometry is laid on the truth's first five metres; the square is the start.");
  put_errors(page, walk);
  page.chart(
      "Steps", gait_chart(walk),
      walk.summary.step_signal == "bounce"
          ? "A valley below the threshold is a foot that lands, left (triangle) and right (diamond) by "
            "turns; outlines are steps filled in. Zoom in to see them."
          : "A peak beyond both thresholds is a step with the left leg (triangle), a valley one with the "
            "right (diamond); outlines are steps filled in. Zoom in to see them [PVO Fig. 3].");
  page.chart("Activity", activity_chart(walk), "Each shading is what was done in that second.");
  page.chart(
      "Speed", speed_chart(walk),
      "From the displacement of the half second about each frame. Unshaded, it is visual odometry's, in "
      "metres by the steps around, or in one unit by the ground; thin lines are the sources by themselves "
      "[SSS Fig. 9].");
  page.chart(
      "", scale_jumps_chart(walk),
      "Visual odometry as it comes: each time it starts again, its unit is another; here all is in the "
      "unit that most frames are in. Speeds beyond the upper edge are cut off [SSS Fig. 9].");
  page.chart("Heading", heading_chart(walk), "Turns are where it changes by 30 degrees or more within 3 s.");
  page.chart("Matches", matches_chart(walk), "Points followed over the tracking window.");
  put_alignment(page, walk.alignment, walk.turns);
  put_settings(page, folder / "config.toml");
  return page.html();
}

}  // namespace retrace
