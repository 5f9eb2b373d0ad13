#pragma once

#include "report/odometry_report.hpp"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include <vo/gait/turns.hpp>

namespace retrace {

/// The facts about a walk in summary.json.
struct OdometrySummary {
  std::string walk;                         ///< where it was read from; empty if not known
  std::string step_signal = "orientation";  ///< the signal that steps were read from
  std::string unit = "m";                   ///< of displacements and positions: "m", "units" or "frames"
  std::optional<double> delta_min, distance, step_length_m, duration_s;
  std::optional<std::int64_t> frames, frames_bridged, steps_bridged;
  std::vector<std::string> warnings;
};

/// The frames, steps and activities of a walk, from the files in its folder.
struct OdometryView {
  struct Frames {
    std::vector<double> time_s, displacement, orientation_deg, matches, heading_deg, signal, threshold;
    std::vector<std::string> source;
    std::vector<std::int64_t> reliable;
    std::vector<double> vo_displacement, sad_displacement;  ///< each source alone
    std::vector<double> vo_as_it_comes;                     ///< with its jumps of scale
  } frames;  ///< for each frame; empty without frames.csv; NaN where there is no value
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
  OdometrySummary summary;
  std::vector<vo::WalkedTurn> turns;
  nlohmann::ordered_json alignment;  ///< see `alignment_data`; empty without
  const OdometryTruth* truth = nullptr;
};

/// Reads a folder written by `retrace odometry`; anything missing stays empty.
OdometryView read_odometry(const std::filesystem::path& folder);

}  // namespace retrace
