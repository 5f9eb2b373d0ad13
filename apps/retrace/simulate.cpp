#include "command.hpp"
#include "drawn_walk_arguments.hpp"
#include "json_file.hpp"
#include "progress_bar.hpp"

#include <filesystem>
#include <memory>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <simulate/recorder.hpp>
#include <vo/base/parallel.hpp>

namespace retrace {
namespace {

struct SimulateOptions {
  simulate::Options walk;
  place::Settings settings;
  CommonOptions common;
  std::string output;
};

void simulate_walk(const SimulateOptions& options) {
  vo::set_thread_count(options.settings.threads.value_or(0));
  const std::filesystem::path folder = options.output;
  simulate::Recording recording;
  {
    ProgressBar bar;
    recording = simulate::simulate_walk(options.walk, folder, options.common.force, bar.callback());
  }
  const std::string video = (folder / "walk.mp4").string(), truth = (folder / "truth.csv").string();
  const simulate::TruthRow& last = recording.last;
  const double walked_m = last.distance_m - options.walk.start_m;
  if (options.common.json) {
    const nlohmann::ordered_json json{{"video", video},
                                      {"truth", truth},
                                      {"frames", recording.frames},
                                      {"duration_s", last.time_s},
                                      {"distance_m", walked_m},
                                      {"steps", last.steps}};
    fmt::print("{}\n", json_text(json, 2));
  } else {
    fmt::print("{}: {} frames, {:.1f} s, {:.1f} m along the route, {} steps; the truth is in {}\n", video,
               recording.frames, last.time_s, walked_m, last.steps, truth);
  }
}

}  // namespace

std::function<void()> declare_simulate(Arguments& arguments) {
  auto options = std::make_shared<SimulateOptions>();
  arguments.option("-o,--output", options->output, "folder for walk.mp4 and truth.csv").required();
  declare_drawn_walk(arguments, options->walk);
  arguments.settings(options->settings, {place::SettingGroup::kGeneral});
  arguments.common(options->common);
  arguments.footer(
      "Two walks of one --scene and --seed are along the same route. Equal options give equal bytes.\n"
      "Examples:\n"
      "  retrace simulate --speed slow-fast -o day\n"
      "  retrace simulate --condition night --speed fast-slow --gait-seed 2 --lateral-m 0.25 -o night");
  return [options] { simulate_walk(*options); };
}

}  // namespace retrace
