#pragma once

#include "place/settings.hpp"

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <vo/base/progress.hpp>

/// Whether a recording is fit to be a reference: measured by `examine_recording`, judged by
/// `judge_recording`.
namespace place {

/// What a recording shows.
struct RecordingFacts {
  std::size_t frames = 0;
  double duration_s = 0;
  int width_px = 0, height_px = 0;  ///< of what is used of its pictures
  double frame_rate_hz = 0;
  double level = 0;            ///< median grey level of its pictures, 0 to 255
  std::optional<double> blur;  ///< median, see `vo::PictureQuality`; none if its pictures are of one colour
  std::size_t steps = 0;
  double steps_hz = 0;       ///< while walking or running
  double walking_share = 0;  ///< of the seconds: walking or running
  /// Of the time, the walker stands still (`vo::standing_frames`).
  double standing_share = 0;
  /// Seconds of walking for which two views have something in common, as far as it was looked at (0.2 s at
  /// most); 0 if no motion was learned.
  double common_view_s = 0;
  std::size_t keyframes = 0;          ///< by alignment error; 0 if none could be taken
  std::string why_no_keyframes;       ///< what `build` would say; empty if it has keyframes
  double steps_spacing_m = 0;         ///< between keyframes with motion steps
  std::vector<std::string> warnings;  ///< of reading and sampling it
};

/// Reads a recording, from one file or several in order, and measures it. `settings`: of reading. Throws
/// `vo::Error` if it cannot be read. Takes the time of `vo::read_walk` with tracked points.
RecordingFacts examine_recording(std::span<const std::string> sources, const Settings& settings,
                                 const vo::ProgressCallback& progress = {});

enum class Fitness { kGood, kWithCare, kUnfit };

/// "good", "with care", "unfit".
std::string_view name_of(Fitness fitness);

/// What one measurement means.
struct Finding {
  std::string check;  ///< "frame rate", "blur", ...
  Fitness fitness = Fitness::kGood;
  std::string text;  ///< a sentence
  std::string help;  ///< the setting, or what to do; empty if there is nothing to do
};

/// The findings, in the order of `RecordingFacts`: frame rate, light, blur, gait, pauses, overlap, keyframes,
/// then a finding "recording" for each warning.
std::vector<Finding> judge_recording(const RecordingFacts& facts);

/// The worst of them.
Fitness worst(std::span<const Finding> findings);

}  // namespace place
