#include "command.hpp"
#include "json_file.hpp"
#include "run_directory.hpp"
#include "walk_reading.hpp"

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <place/describe/npy.hpp>
#include <place/place.hpp>
#include <place/route/motion_choice.hpp>
#include <place/stage_options.hpp>
#include <vo/base/error.hpp>
#include <vo/base/parallel.hpp>
#include <vo/io/atomic_file.hpp>

namespace retrace {
namespace {

struct DescribeOptions {
  place::Settings settings;
  CommonOptions common;
  std::vector<std::string> walk;
  std::string route;
  std::string output;
};

void describe(const DescribeOptions& options) {
  vo::set_thread_count(options.settings.threads.value_or(0));
  const std::string beside = options.output + ".csv";
  for (const std::string& file : {options.output, beside}) {
    check_writable(file);
    if (std::filesystem::exists(file) && !options.common.force)
      throw vo::Error(file, "exists already", "another --output, or --force to write over it");
  }
  place::Route route = options.route.empty() ? place::new_route(options.settings)
                                             : place::read_route(options.route, {.previews = false});
  place::Settings given = options.settings;
  given.preview_width_px = 0;
  place::Settings settings = place::resolve(
      given, {.purpose = place::Purpose::kRoute, .route = options.route.empty() ? nullptr : &route.settings});
  const vo::Walk walk = read_with_bar(options.walk, settings);
  log_warnings(walk.warnings);
  if (settings.motion == "auto")
    settings = place::choose_motion(settings, walk, place::stage_options(settings).sampling.motion.pedestrian)
                   .settings;
  const place::SampledWalk sampled =
      place::sample_walk(walk, place::stage_options(settings).sampling, &route);
  log_warnings(sampled.warnings);
  if (sampled.descriptors.size() != 1)
    throw vo::Error("descriptor", fmt::format("is {}", *settings.descriptor), "one descriptor to write");

  std::string csv = "frame,time_s\n";
  for (const std::size_t frame : sampled.frames) csv += fmt::format("{},{:.6f}\n", frame, walk.time_s[frame]);
  const std::filesystem::path output(options.output);
  StagedFiles staged(output.has_parent_path() ? output.parent_path() : ".");
  const std::filesystem::path file = staged.path() / output.filename();
  const std::size_t width = place::write_npy(file, sampled.descriptors.front());
  vo::write_file(file.string() + ".csv", csv);
  staged.commit();
  if (options.common.json) {
    const nlohmann::ordered_json json{{"descriptors", options.output},
                                      {"frames", beside},
                                      {"descriptor", *settings.descriptor},
                                      {"keyframes", sampled.frames.size()},
                                      {"width", width}};
    fmt::print("{}\n", json_text(json, 2));
    return;
  }
  fmt::print("{}: {} keyframes of {} frames, {} numbers each; their frames are in {}\n", options.output,
             sampled.frames.size(), walk.frames(), width, beside);
}

}  // namespace

std::function<void()> declare_describe(Arguments& arguments) {
  auto options = std::make_shared<DescribeOptions>();
  arguments.positional("walk", options->walk, kWalkArgument);
  arguments
      .option("-o,--output", options->output, "file to write, walk.npy; frames and times go to walk.npy.csv")
      .required();
  arguments.option("--route", options->route,
                   "route database whose vocabulary to take [learned from the walk itself]");
  using enum place::SettingGroup;
  arguments.settings(options->settings, {kReading, kDescribing, kMotion, kOdometry, kGeneral},
                     {"preview-width-px", "view-points"});
  arguments.common(options->common);
  arguments.footer(
      "A row for each keyframe: float32, or uint8 of thumbnails. Descriptors of two walks are comparable "
      "only "
      "with one --route.\n"
      "Examples:\n"
      "  retrace describe day.mp4 -o day.npy --descriptor hog\n"
      "  retrace describe night.mp4 -o night.npy --route route.db");
  return [options] { describe(*options); };
}

}  // namespace retrace
