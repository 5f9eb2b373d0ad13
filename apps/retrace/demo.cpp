#include "command.hpp"
#include "demo_results.hpp"
#include "demo_runs.hpp"
#include "json_file.hpp"
#include "run_directory.hpp"

#include <chrono>
#include <filesystem>
#include <memory>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <vo/base/parallel.hpp>
#include <vo/io/atomic_file.hpp>

namespace retrace {
namespace {

namespace fs = std::filesystem;

struct DemoOptions {
  place::Settings settings;
  CommonOptions common;
  std::string output;
  std::uint64_t seed = 1;
  double length_m = 60;
};

void demo(const DemoOptions& options) {
  const auto began = std::chrono::steady_clock::now();
  vo::set_thread_count(options.settings.threads.value_or(0));
  const simulate::Options by_day = demo_day(options.seed, options.length_m), by_night = demo_night(by_day);
  simulate::validate(by_night);

  place::Settings by_steps;
  by_steps.descriptor = kDemoDescriptor;
  by_steps.motion = "steps";
  by_steps.search = "lines";  // SeqSLAM's, with and without speed normalisation

  const fs::path folder = options.output;
  prepare_run_directory(folder, {"day", "night", "route.db", "vanilla", "normalised", "overview.png"},
                        options.common.force);
  const DrawnWalk day = draw_and_read(by_day, folder / "day", by_steps);
  const DrawnWalk night = draw_and_read(by_night, folder / "night", by_steps);
  const DemoRun normalised =
      find_night_on_day(day, night, by_steps, folder / "route.db", folder / "normalised");
  fs::create_directories(folder / "vanilla");
  const DemoRun vanilla = find_night_on_day(day, night, vanilla_like(normalised, day, night),
                                            folder / "vanilla" / "route.db", folder / "vanilla");
  const std::vector<std::uint8_t> png = demo_overview(day, night, vanilla, normalised, options.length_m);
  vo::write_file(folder / "overview.png", {reinterpret_cast<const char*>(png.data()), png.size()});

  const double took_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  const DemoResults results{options.seed, options.length_m,        vanilla,
                            normalised,   folder / "overview.png", took_s};
  if (options.common.json)
    fmt::print("{}\n", json_text(demo_json(results), 2));
  else
    print_demo(results);
}

}  // namespace

std::function<void()> declare_demo(Arguments& arguments) {
  auto options = std::make_shared<DemoOptions>();
  arguments.option("-o,--output", options->output, "folder for all of it").required();
  arguments.option("--seed", options->seed, "the street");
  arguments.option("--length-m", options->length_m, "metres of street");
  arguments.settings(options->settings, {place::SettingGroup::kGeneral});
  arguments.common(options->common);
  arguments.footer(
      "Then, with the same walks:\n"
      "  retrace video demo/normalised -o side.mp4 --reference demo/day/walk.mp4\n"
      "  retrace follow demo/night/walk.mp4 --route demo/route.db -o followed\n"
      "By hand:\n"
      "  retrace build demo/day/walk.mp4 -o again.db --motion steps --descriptor thumbnail \\\n"
      "    --truth demo/day/truth.csv\n"
      "  retrace localise demo/night/walk.mp4 --route again.db -o again\n"
      "  retrace evaluate again --query-truth demo/night/truth.csv --reference-truth demo/day/truth.csv \\\n"
      "    --tolerance-m 4");
  return [options] { demo(*options); };
}

}  // namespace retrace
