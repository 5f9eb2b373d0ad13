#include "command.hpp"
#include "sweep_files.hpp"
#include "sweep_grid.hpp"
#include "sweep_run.hpp"
#include "truth_options.hpp"

#include <algorithm>
#include <memory>

#include <fmt/format.h>

#include <place/resolve.hpp>
#include <vo/base/error.hpp>
#include <vo/base/parallel.hpp>

namespace retrace {
namespace {

std::vector<Axis> axes_of(const SweepOptions& options) {
  std::vector<Axis> axes{{"motion", options.motions},
                         {"sequence-length", options.lengths},
                         {"search-range-rad", options.ranges}};
  for (const std::string& text : options.vary) {
    axes.push_back(parse_axis(text));
    const auto same = std::ranges::find(axes, axes.back().setting, &Axis::setting);
    if (same != axes.end() - 1)
      throw vo::Error("--vary " + text, "varies a setting twice",
                      fmt::format("one list of {}", same->setting));
  }
  return axes;
}

/// Every cell's settings must be in range and go together, and every setting have an effect in some cell.
void check_settings(const SweepOptions& options, const std::vector<Axis>& axes) {
  place::Settings with_effect;
  for (const Cell& cell : all_cells(axes))
    with_effect = place::merged(
        with_effect, place::resolve(settings_at(options.settings, axes, cell), {.pass_over = true}));
  for (const place::Setting& setting : place::settings_table()) {
    if (place::text_of(options.settings, setting) && !place::text_of(with_effect, setting))
      throw vo::Error(std::string(setting.name), "has no effect in any cell of this sweep",
                      "other axes, or this setting left out");
  }
}

void sweep(const SweepOptions& options) {
  vo::set_thread_count(options.settings.threads.value_or(0));
  const std::vector<Axis> axes = axes_of(options);
  check_settings(options, axes);
  SweepResults results = resume_sweep(options, axes);
  if (!run_sweep(options, axes, results)) {
    throw vo::Error(options.output, "the sweep was stopped",
                    "the same command again, which goes on from here");
  }
  write_sweep_report(options, axes, results);
  print_sweep(options, axes, results);
}

}  // namespace

std::function<void()> declare_sweep(Arguments& arguments) {
  auto options = std::make_shared<SweepOptions>();
  arguments.positional("query", options->query, "walk to be found: video file or folder of images");
  arguments.option("--reference", options->reference, "walk to be found on").required();
  arguments.option("-o,--output", options->output, "folder for the results; a sweep that was stopped goes on")
      .required();
  declare_truth(arguments, options->truth);
  const auto list = [&](const char* flag, std::vector<std::string>& values, const char* description) {
    arguments.option(flag, values, description).comma_separated().group("Swept");
  };
  list("--motion", options->motions, "sad, steps, hybrid, vo, none: what walks are resampled by");
  list("--sequence-length", options->lengths, "keyframes on a line [SSS 4.2]");
  list("--search-range-rad", options->ranges, "radians either side of pi/4 [SSS Fig. 8]");
  arguments
      .option("--vary", options->vary,
              "NAME=a,b,c: any further setting of sampling or search; may be repeated")
      .group("Swept");
  using enum place::SettingGroup;
  arguments.settings(options->settings, {kReading, kDescribing, kMotion, kOdometry, kSearch, kGeneral},
                     {"motion", "sequence-length", "search-range-rad", "compat", "sequence-length-m",
                      "motion-file", "motion-file-start-s", "motion-file-gap-s"});
  arguments.common(options->common);
  arguments.footer(
      "Both walks are read once; a cost matrix is computed once for all cells that share it. With --motion "
      "none and no\n"
      "--every, every so many frames are kept that there are as many keyframes as with the first other "
      "motion.\n"
      "Examples:\n"
      "  retrace sweep night.mp4 --reference day.mp4 --query-truth night.csv --reference-truth day.csv \\\n"
      "    --tolerance-m 4 -o sweep\n"
      "  retrace sweep night.mp4 --reference day.mp4 --pairs pairs.csv --tolerance-frames 17 -o sweep \\\n"
      "    --motion sad,steps,none --sequence-length 5,10,20,40,80 --vary enhance=local,standardise");
  return [options] { sweep(*options); };
}

}  // namespace retrace
