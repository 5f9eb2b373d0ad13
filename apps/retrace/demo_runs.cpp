#include "demo_runs.hpp"

#include "evaluation_files.hpp"
#include "progress_bar.hpp"
#include "report/matrix_picture.hpp"
#include "report/overview.hpp"
#include "run_directory.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>

#include <place/route/survey.hpp>
#include <vo/io/frame_source.hpp>
#include <vo/io/trajectory_io.hpp>

namespace retrace {
namespace {

namespace fs = std::filesystem;

constexpr const char* kReference = "day";

/// The first frame of the video at which the walker had covered this distance.
cv::Mat view_at(const DrawnWalk& drawn, double distance_m) {
  const std::vector<double> along = place::distances_on(drawn.truth());
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

}  // namespace

simulate::Options demo_day(std::uint64_t seed, double length_m) {
  simulate::Options options;
  options.seed = seed;
  options.length_m = length_m;
  options.speed = simulate::Speed::kSlowFast;
  return options;
}

simulate::Options demo_night(const simulate::Options& by_day) {
  simulate::Options options = by_day;
  options.condition = simulate::Condition::kNight;
  options.speed = simulate::Speed::kFastSlow;
  options.gait_seed = by_day.gait_seed + 1;
  options.lateral_m = 0.25;
  return options;
}

DrawnWalk draw_and_read(const simulate::Options& options, const fs::path& folder,
                        const place::Settings& settings) {
  DrawnWalk drawn{folder, {}};
  {
    ProgressBar bar;
    simulate::simulate_walk(options, folder, true, bar.whole_or_nothing());
  }
  ProgressBar bar;
  drawn.walk = place::read(drawn.video(), settings, bar.whole_or_nothing());
  return drawn;
}

DemoRun find_night_on_day(const DrawnWalk& day, const DrawnWalk& night, const place::Settings& settings,
                          const fs::path& route_file, const fs::path& folder) {
  place::Route route = place::new_route(settings);
  place::add(route, kReference, day.walk, place::survey_from_truth(day.truth(), day.walk), settings);
  place::write_route(route_file, route);

  prepare_run_directory(folder, {}, true);
  DemoRun run{folder, settings.every.value_or(0), route.traverses.front().keyframes.size(), {}, {}};
  run.written = localise_into(folder, route, route_file.string(), night.walk, {});
  run.evaluated =
      evaluate_folder(folder, {.pairs = {},
                               .query_truth = night.truth(),
                               .reference_truth = day.truth(),
                               .tolerance = {.tolerance_m = kDemoTolerance_m, .tolerance_frames = {}}})
          .first;
  return run;
}

place::Settings vanilla_like(const DemoRun& run, const DrawnWalk& day, const DrawnWalk& night) {
  const auto frames = static_cast<double>(day.walk.frames() + night.walk.frames());
  const auto keyframes = static_cast<double>(run.references + run.written.run.matches.size());
  place::Settings settings;
  settings.descriptor = kDemoDescriptor;
  settings.motion = "none";
  settings.search = "lines";
  settings.every = std::max(1, static_cast<int>(std::lround(frames / keyframes)));
  return settings;
}

std::vector<std::uint8_t> demo_overview(const DrawnWalk& day, const DrawnWalk& night, const DemoRun& vanilla,
                                        const DemoRun& normalised, double length_m) {
  const auto matrix = [](const DemoRun& run, const std::string& name) {
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

}  // namespace retrace
