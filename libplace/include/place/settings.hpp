#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>

/// Everything that can be set, each setting once: a field of `Settings` and its entry in the table. Flags,
/// TOML, help, validation, the saved configuration and the route database are made from the table.
namespace place {

/// Only what was given: a field without a value was not given. `resolve` (place/resolve.hpp) fills in the
/// rest. Units are in the names; the table gives each setting's meaning, range and source.
struct Settings {
  // Reading
  std::optional<double> frame_rate_hz;
  std::optional<bool> exif_times;
  std::optional<std::string> crop, mask;
  std::optional<int> thumbnail_width, thumbnail_height, preview_width_px;
  std::optional<int> patch_px;
  std::optional<std::string> patch_shape;
  std::optional<double> patch_min_contrast;
  std::optional<bool> view_points;

  // Describing
  std::optional<std::string> descriptor, descriptor_file, descriptor_metric;
  std::optional<std::string> model, model_config, layer, pool, input, mean;
  std::optional<double> scale;
  std::optional<bool> swap_rb;

  // Motion and sampling
  std::optional<std::string> motion, motion_file, motion_file_unit, axes;
  std::optional<double> motion_file_start_s, motion_file_gap_s;
  std::optional<int> every;
  std::optional<double> spacing_m, sampling_n;
  std::optional<int> separations;
  std::optional<double> max_speed, standing_span_s, local_window_s, high_error_mads;
  std::optional<bool> tie_scale;

  // Pedestrian odometry
  std::optional<std::string> camera;
  std::optional<double> fov_deg, step_length, camera_height_m;
  std::optional<std::string> step_length_model;
  std::optional<int> tracking_width_px, tracking_window;
  std::optional<std::string> average, heading;
  std::optional<double> lowpass_cutoff_hz;
  std::optional<std::string> step_signal;
  std::optional<double> min_step_deg;

  // Search
  std::optional<std::string> compat, candidates, search;
  std::optional<int> max_shift_px;
  std::optional<std::string> enhance;
  std::optional<int> enhance_window;
  std::optional<double> sequence_length_m;
  std::optional<int> sequence_length;
  std::optional<double> v_min, v_max, search_range_rad;
  std::optional<double> min_fraction;
  std::optional<int> uniqueness_window;
  std::optional<std::string> score;
  std::optional<double> accept_score, accept_probability;
  std::optional<bool> fuse_traverses;
  std::optional<int> verify;
  std::optional<bool> correct_drift;

  // General
  std::optional<int> threads;

  bool operator==(const Settings&) const = default;
};

/// The group of a setting, which determines the commands that accept it.
enum class SettingGroup { kReading, kDescribing, kMotion, kOdometry, kSearch, kGeneral };

/// "Reading", "Motion and sampling", ... for people.
std::string_view name_of(SettingGroup group);

/// Whether walks on a route share a setting.
enum class OfRoute {
  kNo,         ///< each walk has its own
  kInherited,  ///< a walk without its own value has the route's
  kFixed,      ///< keyframes are comparable only with the same value: another is refused
};

/// The field that holds a setting.
using SettingField = std::variant<std::optional<bool> Settings::*, std::optional<int> Settings::*,
                                  std::optional<double> Settings::*, std::optional<std::string> Settings::*>;

/// An entry of the table.
struct Setting {
  std::string_view name;  ///< of the flag, the TOML key and the keyword: search-range-rad
  SettingField field;
  SettingGroup group = SettingGroup::kGeneral;
  OfRoute of_route = OfRoute::kInherited;
  std::string_view standard;     ///< the default; empty: none, or `resolve` decides
  double least = 0, most = 0;    ///< of a number, both included
  bool above_least = false;      ///< the least itself is excluded
  std::string_view choices;      ///< of a text: a|b|c; empty: any
  std::string_view form;         ///< of a text that is not a file: what it looks like, for people
  std::string_view when;         ///< when it has an effect, see `has_effect`; empty: always
  std::string_view description;  ///< unit, meaning, [source]
  bool everyday = false;         ///< one of the dozen that --help shows
  bool at_reading = false;       ///< affects what is kept of a walk while it is read
};

/// All settings, in the order of their groups.
std::span<const Setting> settings_table();

/// The entry with a name. Throws `vo::Error` with the nearest existing name.
const Setting& setting_named(std::string_view name);

/// The setting's value as text, as in TOML but without quotation marks; none if it has none.
std::optional<std::string> text_of(const Settings& settings, const Setting& setting);

/// Sets it from text. Throws `vo::Error` naming the setting, its value and what was expected.
void set(Settings& settings, const Setting& setting, std::string_view text);

/// Removes the value.
void reset(Settings& settings, const Setting& setting);

/// Throws `vo::Error` for the first value that is out of its range or choices.
void check_ranges(const Settings& settings);

/// The values of `given`, or of `otherwise` where there is none.
Settings merged(const Settings& given, const Settings& otherwise);

/// True if the conditions of `setting.when` hold: `name=a|b`: the setting is one of these; `name!=a|b`: it is
/// not (for a value of several joined by `+`: any of these); `!name`: it has no value; several are joined by
/// `&`. `why_not`: if given, filled with a condition that does not hold, for people ("motion is sad", "camera
/// is given").
bool has_effect(const Settings& settings, const Setting& setting, std::string* why_not = nullptr);

/// The candidate the fewest edits away from `name`; empty if even that takes edits of more than half its
/// letters.
std::string nearest_name(std::string_view name, std::span<const std::string> candidates);

}  // namespace place
