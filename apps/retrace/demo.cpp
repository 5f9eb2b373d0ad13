#include "command.hpp"
#include "demo_runs.hpp"
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
using nlohmann::ordered_json;

struct DemoOptions {
  place::Settings settings;
  CommonOptions common;
  std::string output;
  std::uint64_t seed = 1;
  double length_m = 60;
  bool keep_videos = false;
};

ordered_json as_json(const DemoRun& run) {
  const place::Evaluation& e = run.evaluated.evaluation;
  ordered_json json{{"reference_keyframes", run.references},
                    {"query_keyframes", e.queries},
                    {"max_f1", e.best.f1},
                    {"precision", e.best.precision},
                    {"recall", e.best.recall},
                    {"median_error_m", nullptr},
                    {"p95_error_m", nullptr},
                    {"report", (run.folder / "report.html").string()}};
  if (run.every > 0) json["every"] = run.every;
  if (e.errors) json["median_error_m"] = e.errors->p50;
  if (e.errors) json["p95_error_m"] = e.errors->p95;
  return json;
}

void print_row(const std::string& name, const DemoRun& run) {
  const place::Evaluation& e = run.evaluated.evaluation;
  fmt::print("  {:<28}{:>4} x {:<4}{:>8.3f}{:>11.3f}{:>9.3f}", name, e.queries, run.references, e.best.f1,
             e.best.precision, e.best.recall);
  if (e.errors) fmt::print("{:>12.2f} m{:>12.2f} m", e.errors->p50, e.errors->p95);
  fmt::print("\n");
}

void demo(const DemoOptions& options) {
  const auto began = std::chrono::steady_clock::now();
  vo::set_thread_count(options.settings.threads.value_or(0));
  simulate::Options by_day;
  by_day.seed = options.seed;
  by_day.length_m = options.length_m;
  by_day.speed = simulate::Speed::kSlowFast;
  simulate::Options by_night = by_day;
  by_night.condition = simulate::Condition::kNight;
  by_night.speed = simulate::Speed::kFastSlow;
  by_night.gait_seed = by_day.gait_seed + 1;
  by_night.lateral_m = 0.25;
  simulate::validate(by_night);

  place::Settings by_steps;
  by_steps.descriptor = kDemoDescriptor;
  by_steps.motion = "steps";
  by_steps.search = "lines";  // SeqSLAM's, with and without its walks brought to one speed

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
  if (!options.keep_videos) {
    for (const DrawnWalk* drawn : {&day, &night}) fs::remove(drawn->video());
  }

  const double took_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  if (options.common.json) {
    const ordered_json json{{"seed", options.seed},
                            {"length_m", options.length_m},
                            {"tolerance_m", kDemoTolerance_m},
                            {"vanilla", as_json(vanilla)},
                            {"normalised", as_json(normalised)},
                            {"overview", (folder / "overview.png").string()},
                            {"seconds", took_s}};
    fmt::print("{}\n", json.dump(2));
    return;
  }
  fmt::print("{:g} m of a made-up street, by day (slow, then fast) and by night (fast, then slow):\n\n",
             options.length_m);
  fmt::print("  {:<28}{:>11}{:>8}{:>11}{:>9}{:>14}{:>14}\n", "", "keyframes", "max-F1", "precision", "recall",
             "median error", "95 % within");
  print_row(fmt::format("vanilla, every {}th frame", vanilla.every), vanilla);
  print_row("speed-normalised by steps", normalised);
  fmt::print(
      "\nBoth compare {}s, as the papers do. Right is within {:g} m of the true place. Drawn and found in "
      "{:.0f} s.\n",
      kDemoDescriptor, kDemoTolerance_m, took_s);
  fmt::print("Look at {} and {}.\n", (folder / "overview.png").string(),
             (normalised.folder / "report.html").string());
}

}  // namespace

std::function<void()> declare_demo(Arguments& arguments) {
  auto options = std::make_shared<DemoOptions>();
  arguments.option("-o,--output", options->output, "folder for all of it").required();
  arguments.option("--seed", options->seed, "the street");
  arguments.option("--length-m", options->length_m, "metres of street");
  arguments.flag("--keep-videos", options->keep_videos, "leave the two videos there");
  arguments.settings(options->settings, {place::SettingGroup::kGeneral});
  arguments.common(options->common);
  arguments.footer(
      "The same by hand, with --keep-videos:\n"
      "  retrace build demo/day/walk.mp4 -o again.db --motion steps --descriptor thumbnail \\\n"
      "    --truth demo/day/truth.csv\n"
      "  retrace localise demo/night/walk.mp4 --route again.db -o again\n"
      "  retrace evaluate again --query-truth demo/night/truth.csv --reference-truth demo/day/truth.csv \\\n"
      "    --tolerance-m 4");
  return [options] { demo(*options); };
}

}  // namespace retrace
