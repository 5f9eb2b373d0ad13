#include "command.hpp"
#include "evaluation_files.hpp"
#include "progress_bar.hpp"
#include "report/matrix_picture.hpp"
#include "report/overview.hpp"
#include "run_directory.hpp"
#include "run_files.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <memory>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>

#include <place/route/survey.hpp>
#include <simulate/recorder.hpp>
#include <vo/base/error.hpp>
#include <vo/base/parallel.hpp>
#include <vo/io/atomic_file.hpp>
#include <vo/io/frame_source.hpp>
#include <vo/io/trajectory_io.hpp>

namespace retrace {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

constexpr double kTolerance_m = 4;  // SSS 4.2
/// The papers' descriptor, which shows what the sampling does: blocks find this walk either way.
constexpr const char* kDescriptor = "thumbnail";
constexpr const char* kReference = "day";

struct DemoOptions {
  place::Settings settings;
  CommonOptions common;
  std::string output;
  std::uint64_t seed = 1;
  double length_m = 60;
  bool keep_videos = false;
};

/// A walk drawn into a folder and read back from its video.
struct DrawnWalk {
  fs::path folder;
  vo::Walk walk;

  [[nodiscard]] std::string video() const { return (folder / "walk.mp4").string(); }
  [[nodiscard]] std::string truth() const { return (folder / "truth.csv").string(); }
};

/// A walk found on the other, one way of sampling or another.
struct Run {
  fs::path folder;
  int every = 0;  ///< frames between keyframes, without motion
  std::size_t references = 0;
  WrittenRun written;
  place::RunEvaluation evaluated;
};

/// Half a demo is none: Ctrl-C ends it.
vo::ProgressCallback or_interrupted(ProgressBar& bar) {
  return [show = bar.callback()](const vo::Progress& progress) {
    if (!show(progress)) throw vo::Error(progress.stage, "was interrupted");
    return true;
  };
}

DrawnWalk draw_and_read(const simulate::Options& options, const fs::path& folder,
                        const place::Settings& settings) {
  DrawnWalk drawn{folder, {}};
  {
    ProgressBar bar;
    simulate::simulate_walk(options, folder, true, or_interrupted(bar));
  }
  ProgressBar bar;
  drawn.walk = place::read(drawn.video(), settings, or_interrupted(bar));
  return drawn;
}

/// What `retrace build`, `localise` and `evaluate` do, one after the other.
Run find(const DrawnWalk& day, const DrawnWalk& night, const place::Settings& settings,
         const fs::path& route_file, const fs::path& folder) {
  place::Route route = place::new_route(settings);
  place::add(route, kReference, day.walk, place::survey_from_truth(day.truth(), day.walk), settings);
  place::write_route(route_file, route);

  prepare_run_directory(folder, {}, true);
  Run run{folder, settings.every.value_or(0), route.traverses.front().keyframes.size(), {}, {}};
  run.written = localise_into(folder, route, route_file.string(), night.walk, {});
  run.evaluated =
      evaluate_folder(folder, {.pairs = {},
                               .query_truth = night.truth(),
                               .reference_truth = day.truth(),
                               .tolerance = {.tolerance_m = kTolerance_m, .tolerance_frames = {}}})
          .first;
  return run;
}

/// Keeps every K-th frame, such that there are about as many keyframes as `run` has.
place::Settings vanilla_like(const Run& run, const DrawnWalk& day, const DrawnWalk& night) {
  const auto frames = static_cast<double>(day.walk.frames() + night.walk.frames());
  const auto keyframes = static_cast<double>(run.references + run.written.run.matches.size());
  place::Settings settings;
  settings.descriptor = kDescriptor;
  settings.motion = "none";
  settings.every = std::max(1, static_cast<int>(std::lround(frames / keyframes)));
  return settings;
}

/// The first frame of the video at which the walker had come so far.
cv::Mat view_at(const DrawnWalk& drawn, double distance_m) {
  const std::vector<double> along = vo::read_truth(drawn.truth()).distance_m;
  const auto index = std::ranges::lower_bound(along, distance_m) - along.begin();
  const auto source = vo::open_frame_source(drawn.video(), {.colour_width_px = kOverviewTile_px});
  std::optional<vo::Frame> frame = source->next();
  for (std::ptrdiff_t i = 0; i < index; ++i) {
    std::optional<vo::Frame> next = source->next();
    if (!next) break;
    frame = std::move(next);
  }
  return frame->colour;
}

std::vector<std::uint8_t> overview(const DrawnWalk& day, const DrawnWalk& night, const Run& vanilla,
                                   const Run& normalised, double length_m) {
  const auto matrix = [](const Run& run, const std::string& name) {
    const KeptMatrix& kept = run.written.matrices.front();
    const std::vector<std::uint8_t> png =
        matrix_picture(kept.enhanced, run.written.run.matches, kReference, kOverviewTile_px, kept.shrink);
    return OverviewTile{cv::imdecode(png, cv::IMREAD_COLOR),
                        fmt::format("{}: max-F1 {:.2f}", name, run.evaluated.evaluation.best.f1)};
  };
  const double place_m = 0.4 * length_m;
  return overview_picture({{view_at(day, place_m), "by day, slow, then fast"},
                           {view_at(night, place_m), "the same place by night, fast, then slow"}},
                          {matrix(vanilla, fmt::format("every {}th frame", vanilla.every)),
                           matrix(normalised, "speed-normalised by steps")});
}

ordered_json as_json(const Run& run) {
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

void print_row(const std::string& name, const Run& run) {
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
  by_steps.descriptor = kDescriptor;
  by_steps.motion = "steps";

  const fs::path folder = options.output;
  prepare_run_directory(folder, {"day", "night", "route.db", "vanilla", "normalised", "overview.png"},
                        options.common.force);
  const DrawnWalk day = draw_and_read(by_day, folder / "day", by_steps);
  const DrawnWalk night = draw_and_read(by_night, folder / "night", by_steps);
  const Run normalised = find(day, night, by_steps, folder / "route.db", folder / "normalised");
  fs::create_directories(folder / "vanilla");
  const Run vanilla = find(day, night, vanilla_like(normalised, day, night), folder / "vanilla" / "route.db",
                           folder / "vanilla");
  const std::vector<std::uint8_t> png = overview(day, night, vanilla, normalised, options.length_m);
  vo::write_file(folder / "overview.png", {reinterpret_cast<const char*>(png.data()), png.size()});
  if (!options.keep_videos) {
    for (const DrawnWalk* drawn : {&day, &night}) fs::remove(drawn->video());
  }

  const double took_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  if (options.common.json) {
    const ordered_json json{{"seed", options.seed},
                            {"length_m", options.length_m},
                            {"tolerance_m", kTolerance_m},
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
      kDescriptor, kTolerance_m, took_s);
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
