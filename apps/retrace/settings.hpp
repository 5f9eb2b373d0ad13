#pragma once

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include <place/localiser.hpp>
#include <vo/motion/external_trajectory.hpp>
#include <vo/odometry.hpp>

/// Everything a user can set, declared to CLI11 once: flags, TOML, --help, validation and the saved
/// configuration all come from these declarations.
namespace retrace {

/// Which program's search is run.
enum class Compatibility {
  kNone,               ///< ours
  kOpenSeqSlam,        ///< the original, quirks included
  kOpenSeqSlamMended,  ///< the original, but a constant patch is neutral
};

struct Settings {
  vo::WalkOptions walk;
  vo::PatchNormalisationOptions patch;
  place::WalkSamplingOptions sampling;
  place::LocaliserOptions localiser;
  std::string camera;                      ///< calibration file; empty: by the field of view
  std::string motion_file;                 ///< trajectory for --motion file
  vo::ExternalTrajectoryOptions external;  ///< how it is matched to frames
  Compatibility compatibility = Compatibility::kNone;
  bool correct_drift = true;
  int threads = 0;
};

/// How frames become thumbnails, and how those are described: what every walk on a route has in common.
void add_frame_options(CLI::App& app, Settings& settings);
/// How a walk becomes keyframes.
void add_sampling_options(CLI::App& app, Settings& settings);
/// Steps, heading and step length.
void add_odometry_options(CLI::App& app, Settings& settings);
/// Enhancement, search and acceptance.
void add_search_options(CLI::App& app, Settings& settings);
/// What every command has.
void add_general_options(CLI::App& app, Settings& settings);
/// All of these.
void add_all_options(CLI::App& app, Settings& settings);

/// One setting as text.
struct SettingEntry {
  std::string group;
  std::string name;
  std::string value;  ///< as in TOML; empty if it has none
  std::string description;
};

/// All settings with their values.
std::vector<SettingEntry> entries(const Settings& settings);

/// The settings as a commented TOML file that --config reads.
std::string to_toml(const Settings& settings);

/// True if the user gave the option, on the command line or in a file.
bool given(const CLI::App& app, const std::string& option);

/// Has what the motion source needs kept of the walk.
void follow_motion(Settings& settings);

/// Reads a recording with what the settings ask to be kept, and with --motion file gives it the file's track.
vo::Walk read_walk(const std::string& source, const Settings& settings, const vo::ProgressCallback& progress);

/// Puts the settings that follow from others in place (the original's options from --compat). Throws
/// `vo::Error` for settings that do not go together.
void resolve(const CLI::App& app, Settings& settings);

}  // namespace retrace
