#include "place/route/recording_check.hpp"

#include "place/resolve.hpp"
#include "place/route/walk_sampling.hpp"
#include "place/stage_options.hpp"

#include <algorithm>
#include <cstring>

#include <fmt/format.h>

#include <vo/base/clock.hpp>
#include <vo/base/error.hpp>
#include <vo/base/median.hpp>
#include <vo/image/grey.hpp>
#include <vo/image/picture_quality.hpp>
#include <vo/odometry.hpp>

namespace place {
namespace {

constexpr std::int64_t kMeasuredEvery = 5;  // frames; blur and light last longer
constexpr double kNoBlur = -1;              // of a picture of one colour, in a record

/// Level and blur of every fifth frame.
std::vector<std::uint8_t> quality_record(const vo::Frame& frame) {
  if (frame.index % kMeasuredEvery != 0) return {};
  const vo::PictureQuality quality = vo::picture_quality(vo::grey_of(frame.image, frame.image.cols));
  const double values[] = {quality.level, quality.blur.value_or(kNoBlur)};
  std::vector<std::uint8_t> bytes(sizeof(values));
  std::memcpy(bytes.data(), values, sizeof(values));
  return bytes;
}

void add_quality(const std::vector<std::vector<std::uint8_t>>& records, RecordingFacts& facts) {
  std::vector<double> levels, blurs;
  for (const std::vector<std::uint8_t>& bytes : records) {
    double values[2];
    if (bytes.size() != sizeof(values)) continue;
    std::memcpy(values, bytes.data(), sizeof(values));
    levels.push_back(values[0]);
    if (values[1] != kNoBlur) blurs.push_back(values[1]);
  }
  if (!levels.empty()) facts.level = vo::median(std::move(levels));
  if (!blurs.empty()) facts.blur = vo::median(std::move(blurs));
}

void add_gait(const vo::Walk& walk, const vo::PedestrianMotionOptions& options, RecordingFacts& facts) {
  const vo::PedestrianMotion motion = vo::pedestrian_motion(walk, options);
  facts.steps = motion.detection.steps.size();
  std::size_t walked = 0;
  double steps_hz = 0;
  for (const vo::ActivitySecond& second : motion.activity) {
    if (second.activity != vo::Activity::kWalking && second.activity != vo::Activity::kRunning) continue;
    ++walked;
    steps_hz += second.step_hz;
  }
  if (walked == 0) return;
  facts.walking_share = static_cast<double>(walked) / static_cast<double>(motion.activity.size());
  facts.steps_hz = steps_hz / static_cast<double>(walked);
}

void add_motion(const vo::Walk& walk, const WalkSamplingOptions& options, RecordingFacts& facts) {
  const std::optional<vo::VisualMotion> visual = vo::visual_motion_if_any(walk, options.motion.visual);
  facts.standing_share = 1;
  if (visual) {
    double standing_s = 0;
    for (std::size_t i = 1; i < walk.frames(); ++i)
      if (visual->standing[i]) standing_s += walk.time_s[i] - walk.time_s[i - 1];
    facts.standing_share = standing_s / walk.time_s.back();
    if (visual->model.learned()) facts.common_view_s = visual->model.separation.back();
  }
  try {
    const SampledWalk sampled = sample_walk(walk, options);
    facts.keyframes = sampled.frames.size();
    facts.warnings.insert(facts.warnings.end(), sampled.warnings.begin(), sampled.warnings.end());
  } catch (const vo::Error& error) {
    facts.why_no_keyframes = error.what();
  }
}

Finding frame_rate(const RecordingFacts& facts) {
  constexpr double kShowsSteps_hz = 8;  // twice the cut-off of the gait signal
  Finding finding{
      "frame rate", Fitness::kGood, fmt::format("{:.4g} frames a second", facts.frame_rate_hz), {}};
  if (facts.frame_rate_hz > kShowsSteps_hz) return finding;
  finding.fitness = Fitness::kWithCare;
  finding.text += ", too few to see steps";
  finding.help = "record with more than 8";
  return finding;
}

Finding light(const RecordingFacts& facts) {
  constexpr double kBlack = 8, kDark = 40;  // simulated walks by night have 25, real ones at dusk 60
  Finding finding{"light", Fitness::kGood, fmt::format("mean grey level {:.0f} of 255", facts.level), {}};
  if (facts.level >= kDark) return finding;
  finding.fitness = facts.level < kBlack ? Fitness::kUnfit : Fitness::kWithCare;
  finding.text += facts.level < kBlack ? ": black" : ": dark";
  finding.help = "a reference by day; walks by night are found on it";
  return finding;
}

Finding sharpness(const RecordingFacts& facts) {
  constexpr double kBlurred = 0.5;
  if (!facts.blur) return {"blur", Fitness::kUnfit, "pictures of one colour", "look at the recording"};
  Finding finding{"blur", Fitness::kGood, fmt::format("{:.2f} (0 sharp, 1 smooth)", *facts.blur), {}};
  if (*facts.blur < kBlurred) return finding;
  finding.fitness = Fitness::kWithCare;
  finding.text += ": blurred";
  finding.help = "clean the lens, more light or a shorter exposure";
  return finding;
}

Finding gait(const RecordingFacts& facts) {
  constexpr double kMostly = 0.5;
  if (facts.steps == 0) {
    return {
        "gait", Fitness::kWithCare, "no steps can be seen, so distances are not in metres",
        "a camera that is worn, its picture not steadied; in a car, --motion hybrid --camera-height-m; of a "
        "time lapse, --frame-rate-hz; of pictures taken one by one, --motion none --every 1"};
  }
  Finding finding{"gait", Fitness::kGood,
                  fmt::format("{} steps, {:.2f} a second, during {:.0f} % of the time", facts.steps,
                              facts.steps_hz, 100 * facts.walking_share),
                  "--motion steps gives distances in metres"};
  if (facts.walking_share >= kMostly || facts.walking_share + facts.standing_share >= 0.9) return finding;
  finding.fitness = Fitness::kWithCare;
  finding.help = "keep the default --motion sad: steps would miss much of the walk";
  return finding;
}

Finding pauses(const RecordingFacts& facts) {
  constexpr double kMuch = 0.5;
  Finding finding{"pauses",
                  Fitness::kGood,
                  fmt::format("still during {:.0f} % of the time", 100 * facts.standing_share),
                  {}};
  if (facts.standing_share < kMuch) return finding;
  finding.fitness = facts.standing_share < 1 ? Fitness::kWithCare : Fitness::kUnfit;
  finding.help = facts.standing_share < 1
                     ? "nothing: pauses are found and left out; a shorter one reads faster"
                     : "a recording of a walk";
  return finding;
}

Finding overlap(const RecordingFacts& facts) {
  if (facts.common_view_s <= 0)
    return {"overlap", Fitness::kUnfit, "no motion can be learned from its views",
            "a higher frame rate, or --motion none"};
  if (facts.common_view_s >= kLeastCommonView_s)
    return {"overlap", Fitness::kGood, "views in succession have enough in common", {}};
  return {"overlap", Fitness::kWithCare,
          fmt::format("views more than {:.2f} s apart have nothing in common", facts.common_view_s),
          "a higher frame rate, or --motion none"};
}

Finding keyframes(const RecordingFacts& facts) {
  constexpr std::size_t kFew = 15;  // too few to tie the scales of two walks
  if (facts.keyframes == 0)
    return {"keyframes", Fitness::kUnfit, facts.why_no_keyframes, "a recording of a walk"};
  const double moving_s = facts.duration_s * (1 - facts.standing_share);
  Finding finding{"keyframes",
                  Fitness::kGood,
                  fmt::format("{} with the default --motion sad, one each {:.2f} s of walking",
                              facts.keyframes, moving_s / static_cast<double>(facts.keyframes)),
                  {}};
  if (facts.steps > 0)
    finding.text += fmt::format("; {:g} m apart with --motion steps", facts.steps_spacing_m);
  if (facts.keyframes >= kFew) return finding;
  finding.fitness = Fitness::kWithCare;
  finding.text += ": a short route";
  finding.help = "walk further, or a smaller --sampling-n";
  return finding;
}

}  // namespace

RecordingFacts examine_recording(std::span<const std::string> sources, const Settings& settings,
                                 const vo::ProgressCallback& progress) {
  StageOptions stages = stage_options(resolve(settings, {.purpose = Purpose::kRoute}));
  stages.walk.track_features = true;
  stages.walk.preview_width_px = 0;
  stages.walk.recorders = {quality_record};
  stages.sampling.descriptors = nullptr;  // where keyframes lie does not depend on them
  vo::Walk walk = vo::read_walk(sources, stages.walk, progress);
  RecordingFacts facts{.frames = walk.frames(),
                       .duration_s = walk.time_s.back(),
                       .width_px = walk.frame_width_px,
                       .height_px = walk.frame_height_px,
                       .frame_rate_hz = vo::frame_rate_hz(walk.time_s),
                       .warnings = walk.warnings};
  Settings by_steps = settings;
  by_steps.motion = "steps";
  facts.steps_spacing_m = resolve(by_steps, {.purpose = Purpose::kRoute}).spacing_m.value_or(0);
  add_quality(walk.records.front(), facts);
  const vo::PedestrianMotionOptions& pedestrian = stages.sampling.motion.pedestrian;
  if (facts.frame_rate_hz > 2 * pedestrian.signal.lowpass.cutoff_hz) {
    add_gait(walk, pedestrian, facts);
  } else {
    walk.tracked.clear();  // so few frames a second show steps that nobody made
  }
  add_motion(walk, stages.sampling, facts);
  return facts;
}

std::string_view name_of(Fitness fitness) {
  switch (fitness) {
    case Fitness::kGood:
      return "good";
    case Fitness::kWithCare:
      return "with care";
    case Fitness::kUnfit:
      break;
  }
  return "unfit";
}

std::vector<Finding> judge_recording(const RecordingFacts& facts) {
  std::vector<Finding> findings{frame_rate(facts), light(facts),   sharpness(facts), gait(facts),
                                pauses(facts),     overlap(facts), keyframes(facts)};
  for (const std::string& warning : facts.warnings)
    findings.push_back({"recording", Fitness::kWithCare, warning, {}});
  return findings;
}

Fitness worst(std::span<const Finding> findings) {
  Fitness worst = Fitness::kGood;
  for (const Finding& finding : findings) worst = std::max(worst, finding.fitness);
  return worst;
}

}  // namespace place
