#include "command.hpp"
#include "follow_files.hpp"
#include "follow_lines.hpp"
#include "follow_matches.hpp"
#include "follow_page.hpp"
#include "follow_record.hpp"
#include "follow_view.hpp"
#include "interruption.hpp"
#include "newest_frame.hpp"
#include "run_directory.hpp"

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <place/certainty/announcer.hpp>
#include <place/certainty/follower.hpp>
#include <place/route/route_database.hpp>
#include <vo/base/error.hpp>
#include <vo/base/parallel.hpp>
#include <vo/io/atomic_file.hpp>
#include <vo/io/frame_source.hpp>

namespace retrace {
namespace {

constexpr double kPatience_s = 10;  // a camera that sends no picture for so long hangs

struct FollowOptions {
  place::Settings settings;
  CommonOptions common;
  std::string walk;
  std::string route;
  std::string output;
  double lag_s = 0;
  bool announce = false;
  std::optional<std::size_t> view;
  std::string view_address = FollowViewOptions{}.address;
};

/// What an earlier run may have left that this one does not write: it would belong to other matches.
const std::vector<std::string> kStaleFiles{
    "metrics.json",       "pr.csv",         "errors.csv",     "evaluation.html",
    "trajectory.geojson", "trajectory.gpx", "trajectory.csv", "trajectory_odometry.tum",
    "report_data.json"};

/// True for what does not wait for a slow reader.
bool is_live(const std::string& walk) {
  return walk.starts_with("camera:") || walk.starts_with("rtsp://");
}

void follow(const FollowOptions& options) {
  vo::set_thread_count(options.settings.threads.value_or(0));
  check_not_swapped(options.walk, options.route);
  const bool shown = !options.output.empty() || options.view;
  const place::Route route = place::read_route(options.route, {.previews = shown, .view_points = false});
  place::Follower follower(route, options.settings, {.lag_s = options.lag_s});
  place::Announcer announcer(route);
  if (!options.output.empty()) prepare_run_directory(options.output, kFollowFiles, options.common.force);
  std::optional<FollowView> view;
  if (options.view) {
    view.emplace(route, options.walk,
                 FollowViewOptions{options.view_address, static_cast<int>(*options.view)});
    fmt::print(stderr, "the page is at {}\n", view->url());
  }
  vo::FrameSourceOptions reading = follower.frame_source();
  if (shown) reading.colour_width_px = std::max(reading.colour_width_px, kFollowPicture_px);
  std::unique_ptr<vo::FrameSource> source = vo::open_frame_source(options.walk, reading);
  const vo::FrameSource& opened = *source;
  std::optional<NewestFrame> newest;
  if (is_live(options.walk)) newest.emplace(std::move(source));

  const EndableReading endable;
  std::optional<StagedFiles> staged;
  if (!options.output.empty()) staged.emplace(options.output);
  FollowLines lines(staged ? staged->path() : std::filesystem::path());
  FollowRecord record;
  FollowMatches matches(route);
  FollowRun run{.walk = options.walk, .route = options.route, .lag_s = options.lag_s};
  std::string trouble;
  while (!EndableReading::ended()) {
    std::optional<vo::Frame> frame;
    try {
      frame = newest ? newest->next(kPatience_s) : source->next();
    } catch (const vo::Error& error) {
      trouble = error.what();
      break;
    }
    if (!frame) break;
    const place::Position position = follower.push(*frame);
    lines.write(follow_line(position));
    ++run.frames;
    run.on_route += position.place ? 1 : 0;
    run.duration_s = position.time_s;
    if (!options.output.empty()) {
      record.push(position, *frame);
      matches.push(position);
    }
    const std::vector<place::FollowEvent> events = announcer.push(position);
    if (view) view->push(position, *frame, events);
    if (!options.announce) continue;
    for (const place::FollowEvent& event : events) lines.write(event_line(event));
  }
  lines.finish();
  run.skipped = newest ? newest->dropped() : 0;
  if (run.skipped > 0)
    run.warnings.push_back(fmt::format("{}: {} frames were skipped, to keep up", options.walk, run.skipped));
  if (!newest) {
    run.warnings = opened.warnings();
    run.start_utc_s = opened.start_utc_s();
  }
  if (staged) {
    matches.finish(follower.finish());
    write_follow_files(staged->path(), run, route, follower.settings(), matches.matches());
    vo::write_file(staged->path() / "report.html", record.page(route, options.walk));
    staged->commit(kStaleFiles);
  }
  for (const std::string& warning : run.warnings) spdlog::warn("{}", warning);
  if (!trouble.empty())
    throw vo::Error(options.walk, trouble, "a source that goes on; what was seen is kept");
  if (newest && !EndableReading::ended())
    throw vo::Error(options.walk, fmt::format("sent no picture for {:g} s", kPatience_s),
                    "a camera that goes on; what was seen is kept");
}

}  // namespace

std::function<void()> declare_follow(Arguments& arguments) {
  auto options = std::make_shared<FollowOptions>();
  arguments.positional(
      "walk", options->walk,
      "video file, folder of images, camera:N, an rtsp:// address, or - (Y4M on standard input)");
  arguments.option("--route", options->route, "route database").required();
  arguments.option(
      "-o,--output", options->output,
      "folder for follow.jsonl, what localise writes of a run, and report.html, which plays the walk "
      "[none]");
  arguments.option("--lag-s", options->lag_s, "seconds that a second, surer answer looks back by; 0: none")
      .range(0, 60);
  arguments.flag("--announce", options->announce,
                 "events as lines of their own: found, left_route, back_on_route, turn_ahead, passing, "
                 "end_of_route");
  const Argument view =
      arguments
          .option("--view", options->view,
                  "port at which this machine's browser sees the walk; 0: any, which is printed")
          .range(0, 65535);
  arguments
      .option("--view-address", options->view_address,
              "address to serve the page at; another than the default is for others to see it too")
      .needs(view);
  using enum place::SettingGroup;
  arguments.settings(options->settings, {kReading, kGeneral}, {"preview-width-px", "view-points"});
  arguments.force(options->common);
  arguments.footer(
      "Prints one JSON object for each frame: frame, time_s, state (searching, on_route, off_route), and on "
      "the\n"
      "route traverse, reference_frame, distance_m, sd_m, probability, with poses x_m, y_m, heading_deg.\n"
      "Examples:\n"
      "  retrace follow camera:0 --route route.db --announce\n"
      "  ffmpeg -i rtsp://... -f yuv4mpegpipe - | retrace follow - --route route.db");
  return [options] { follow(*options); };
}

}  // namespace retrace
