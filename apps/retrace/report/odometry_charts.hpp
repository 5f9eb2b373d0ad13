#pragma once

#include "report/chart.hpp"
#include "report/odometry_report.hpp"

#include <filesystem>
#include <optional>

#include <nlohmann/json.hpp>

namespace retrace {

/// The frames, steps and activities of a walk, as they lie in its folder.
struct OdometryView {
  struct Frames {
    std::vector<double> time_s, displacement, orientation_deg, matches, heading_deg, signal, threshold;
    std::vector<std::string> source;
    std::vector<std::int64_t> reliable;
  } frames;  ///< by frame; empty without frames.csv, and NaN where there is no value
  struct Steps {
    std::vector<double> time_s;
    std::vector<std::int64_t> frame, bridged;
    std::vector<std::string> leg;
  } steps;
  struct Seconds {
    std::vector<double> time_s, amplitude_deg, step_hz;
    std::vector<std::string> activity;
  } activity;
  vo::Trajectory trajectory;
  nlohmann::ordered_json summary;  ///< summary.json, or empty
  const OdometryTruth* truth = nullptr;
};

/// Reads a folder written by `retrace odometry`; what is not there stays empty.
OdometryView read_odometry(const std::filesystem::path& folder);

// Each gives none where the walk has not what it would show.
/// Orientation with thresholds and steps, left and right (PVO Fig. 3).
std::optional<Chart> gait_chart(const OdometryView& walk);
std::optional<Chart> activity_chart(const OdometryView& walk);
std::optional<Chart> heading_chart(const OdometryView& walk);
/// Speed, with what it comes from where visual odometry is lost shaded; with the truth's (SSS Fig. 9).
std::optional<Chart> speed_chart(const OdometryView& walk);
/// Matches of each frame, where too few shaded.
std::optional<Chart> matches_chart(const OdometryView& walk);
/// The trajectory, laid on the truth where there is one.
std::optional<Chart> trajectory_chart(const OdometryView& walk);
/// Error against distance with its standard deviation (PVO Fig. 7).
std::optional<Chart> position_error_chart(const OdometryView& walk);
std::optional<Chart> heading_error_chart(const OdometryView& walk);

}  // namespace retrace
