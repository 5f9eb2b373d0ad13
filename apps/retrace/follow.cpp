#include "command.hpp"
#include "follow_page.hpp"
#include "follow_results.hpp"
#include "follow_view.hpp"
#include "followed_source.hpp"
#include "run_directory.hpp"
#include "walk_reading.hpp"

#include <algorithm>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include <place/certainty/announcer.hpp>
#include <place/certainty/follower.hpp>
#include <place/route/route_database.hpp>
#include <vo/base/parallel.hpp>
#include <vo/io/frame_source.hpp>

namespace retrace {
namespace {

struct FollowOptions {
  place::Settings settings;
  CommonOptions common;
  std::string walk;
  std::string route;
  std::string output;
  double lag_s = 0;
  bool announce = false;
  FollowViewOptions view;
};

void follow(const FollowOptions& options) {
  if (options.common.force && options.output.empty())
    throw UsageError("--force has no effect without --output");
  vo::set_thread_count(options.settings.threads.value_or(0));
  check_not_swapped(options.walk, options.route);
  const bool shown = !options.output.empty() || options.view.port;
  const place::Route route = place::read_route(options.route, {.previews = shown, .view_points = false});
  place::Follower follower(route, options.settings, {.lag_s = options.lag_s});
  place::Announcer announcer(route);
  if (!options.output.empty()) prepare_run_directory(options.output, kFollowFiles, options.common.force);
  std::optional<FollowView> view;
  if (options.view.port) {
    view.emplace(route, options.walk, options.view);
    fmt::print(stderr, "the page is at {}\n", view->url());
  }
  vo::FrameSourceOptions reading = follower.frame_source();
  if (shown) reading.colour_width_px = std::max(reading.colour_width_px, kFollowPicture_px);

  FollowedSource source(options.walk, vo::open_frame_source(options.walk, reading));
  FollowResults results(route, options.output);
  while (const std::optional<vo::Frame> frame = source.next()) {
    const place::Position position = follower.push(*frame);
    const std::vector<place::FollowEvent> events = announcer.push(position);
    results.push(position, *frame, options.announce ? events : std::vector<place::FollowEvent>());
    if (view) view->push(position, *frame, events);
  }
  const std::vector<std::string> warnings = source.warnings();
  const FollowRun run{.walk = options.walk,
                      .route = options.route,
                      .skipped = source.skipped(),
                      .lag_s = options.lag_s,
                      .start_utc_s = source.start_utc_s(),
                      .warnings = warnings};
  results.finish(run, follower.settings(), follower.finish());
  log_warnings(warnings);
  source.check_end();
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
  declare_view(arguments, options->view);
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
