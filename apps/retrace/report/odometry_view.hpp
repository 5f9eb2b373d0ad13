#pragma once

#include "report/odometry_report.hpp"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace retrace {

/// The frames, steps and activities of a walk, as they lie in its folder.
struct OdometryView {
  struct Frames {
    std::vector<double> time_s, displacement, orientation_deg, matches, heading_deg, signal, threshold;
    std::vector<std::string> source;
    std::vector<std::int64_t> reliable;
    std::vector<double> vo_displacement, sad_displacement;  ///< each source alone
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

/// What displacements and positions are measured in: "m", or where nothing tells metres "units" or "frames".
std::string unit_of(const OdometryView& walk);

/// Reads a folder written by `retrace odometry`; what is not there stays empty.
OdometryView read_odometry(const std::filesystem::path& folder);

}  // namespace retrace
