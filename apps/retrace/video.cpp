#include "command.hpp"
#include "progress_bar.hpp"
#include "run_directory.hpp"
#include "run_summary.hpp"
#include "side_video.hpp"
#include "side_video_input.hpp"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>

#include <place/match/match_io.hpp>
#include <place/route/route_database.hpp>
#include <vo/base/error.hpp>

namespace retrace {
namespace {

namespace fs = std::filesystem;

struct VideoOptions {
  CommonOptions common;
  SideVideoInput input;
  std::string output;
};

void video(VideoOptions options) {
  const fs::path folder = options.input.folder, output = options.output;
  if (output.extension() != ".mp4")
    throw vo::Error(options.output, "is no video's name", "a name ending in .mp4");
  check_new_file(output, options.common.force, "another name");
  std::vector<place::Match> matches = place::read_matches(folder / "matches.csv");
  const RunSummary summary = read_run_summary(folder);
  if (summary.query_frames == 0)
    throw vo::Error((folder / "summary.json").string(), "does not say how many frames the query has",
                    "a folder written by `retrace localise`");
  if (matches.back().query_frame >= static_cast<std::int64_t>(summary.query_frames))
    throw vo::Error((folder / "matches.csv").string(),
                    fmt::format("has query_frame {}", matches.back().query_frame),
                    fmt::format("the {} frames that summary.json says the query has", summary.query_frames));
  if (options.input.route.empty()) options.input.route = summary.route;
  const place::Route route = place::read_route(options.input.route, {.view_points = false});
  place::locate(matches, route);
  SideVideo side = side_video_of(options.input, route, matches, summary);
  ProgressBar bar;
  const double rate_hz = write_side_video(output, side, bar.whole_or_nothing());
  fmt::print("{}: {} frames at {:.4g} frames/s\n", options.output, side.timeline.size(), rate_hz);
}

}  // namespace

std::function<void()> declare_video(Arguments& arguments) {
  auto options = std::make_shared<VideoOptions>();
  arguments.positional("run", options->input.folder, "folder written by `retrace localise`");
  arguments.option("-o,--output", options->output, "video to write, .mp4").required();
  arguments.option("--query", options->input.query,
                   "where the query's recording is now [as the run knows it]");
  arguments.option(
      "--reference", options->input.reference,
      "where the reference's recording is now, NAME=FILE for a route of several traverses [beside "
      "the route]; else small pictures from the route are shown");
  arguments.option("--route", options->input.route, "where the route database is now [as the run knows it]");
  arguments.option("--width-px", options->input.width_px, "pixels, width of the video").range(160, 3840);
  arguments.flag(
      "--warp", options->input.warp,
      "turn the reference to the query's view by the yaw of `localise --verify`: a rotation only, so "
      "what is near stays shifted if the walker was to the side");
  arguments.flag("--blink", options->input.blink,
                 "below, reference (turned where the yaw is known) and query take turns, half a second each");
  arguments.force(options->common);
  arguments.footer(
      "Examples:\n"
      "  retrace video run -o side.mp4\n"
      "  retrace video run -o side.mp4 --query night.mp4 --reference day.mp4 --blink");
  return [options] { video(*options); };
}

}  // namespace retrace
