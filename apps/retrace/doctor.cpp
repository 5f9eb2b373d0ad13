#include "command.hpp"
#include "json_file.hpp"
#include "progress_bar.hpp"

#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <place/route/recording_check.hpp>
#include <vo/base/parallel.hpp>

namespace retrace {
namespace {

using nlohmann::ordered_json;

struct DoctorOptions {
  place::Settings settings;
  CommonOptions common;
  std::vector<std::string> walk;
};

ordered_json json_of(const DoctorOptions& options, const place::RecordingFacts& facts,
                     const std::vector<place::Finding>& findings) {
  ordered_json json{{"recording", options.walk.front()},
                    {"fitness", place::name_of(place::worst(findings))},
                    {"frames", facts.frames},
                    {"duration_s", facts.duration_s},
                    {"frame_size", {facts.width_px, facts.height_px}},
                    {"frame_rate_hz", facts.frame_rate_hz},
                    {"grey_level", facts.level},
                    {"blur", facts.blur ? ordered_json(*facts.blur) : nullptr},
                    {"steps", facts.steps},
                    {"steps_hz", facts.steps_hz},
                    {"walking_share", facts.walking_share},
                    {"standing_share", facts.standing_share},
                    {"common_view_s", facts.common_view_s},
                    {"motion", "sad"},
                    {"keyframes", facts.keyframes},
                    {"steps_spacing_m", facts.steps_spacing_m},
                    {"findings", ordered_json::array()}};
  for (const place::Finding& finding : findings) {
    json["findings"].push_back({{"check", finding.check},
                                {"fitness", place::name_of(finding.fitness)},
                                {"text", finding.text},
                                {"help", finding.help}});
  }
  return json;
}

const char* verdict(place::Fitness fitness) {
  switch (fitness) {
    case place::Fitness::kGood:
      return "fit to be a reference";
    case place::Fitness::kWithCare:
      return "fit to be a reference, with care";
    case place::Fitness::kUnfit:
      break;
  }
  return "not fit to be a reference";
}

void doctor(const DoctorOptions& options) {
  vo::set_thread_count(options.settings.threads.value_or(0));
  place::RecordingFacts facts;
  {
    ProgressBar bar(options.walk.front());
    facts = place::examine_recording(options.walk, options.settings, bar.callback());
  }
  const std::vector<place::Finding> findings = place::judge_recording(facts);
  if (options.common.json) {
    fmt::print("{}\n", json_text(json_of(options, facts, findings), 2));
    return;
  }
  fmt::print("{}: {} frames of {}x{} px, {:.1f} s: {}\n", options.walk.front(), facts.frames, facts.width_px,
             facts.height_px, facts.duration_s, verdict(place::worst(findings)));
  for (const place::Finding& finding : findings) {
    fmt::print("  {:<10} {:<10} {}\n", finding.check, place::name_of(finding.fitness), finding.text);
    if (!finding.help.empty()) fmt::print("  {:<21} {}\n", "", finding.help);
  }
}

}  // namespace

std::function<void()> declare_doctor(Arguments& arguments) {
  auto options = std::make_shared<DoctorOptions>();
  arguments.positional("walk", options->walk, kWalkArgument);
  using enum place::SettingGroup;
  arguments.settings(options->settings, {kReading, kGeneral}, {"preview-width-px", "view-points"});
  arguments.json(options->common);
  arguments.footer("Example:\n  retrace doctor day.mp4");
  return [options] { doctor(*options); };
}

}  // namespace retrace
