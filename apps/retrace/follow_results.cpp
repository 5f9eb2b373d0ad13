#include "follow_results.hpp"

#include <string>

#include <vo/io/atomic_file.hpp>

namespace retrace {
namespace {

/// What an earlier run may have left that this one does not write: it would belong to other matches.
const std::vector<std::string> kStaleFiles{
    "metrics.json",       "pr.csv",         "errors.csv",     "evaluation.html",
    "trajectory.geojson", "trajectory.gpx", "trajectory.csv", "trajectory_odometry.tum",
    "report_data.json"};

}  // namespace

FollowResults::FollowResults(const place::Route& route, const std::filesystem::path& folder)
    : route_(route),
      staged_(folder.empty() ? nullptr : std::make_unique<StagedFiles>(folder)),
      lines_(staged_ ? staged_->path() : std::filesystem::path()),
      matches_(route) {}

void FollowResults::push(const place::Position& position, const vo::Frame& frame,
                         const std::vector<place::FollowEvent>& announced) {
  lines_.write(follow_line(position));
  for (const place::FollowEvent& event : announced) lines_.write(event_line(event));
  ++frames_;
  on_route_ += position.place ? 1 : 0;
  duration_s_ = position.time_s;
  if (!staged_) return;
  record_.push(position, frame);
  matches_.push(position);
}

void FollowResults::finish(FollowRun run, const place::Settings& settings,
                           const std::vector<place::EarlierPlace>& earlier) {
  lines_.finish();
  if (!staged_) return;
  run.frames = frames_;
  run.on_route = on_route_;
  run.duration_s = duration_s_;
  matches_.finish(earlier);
  write_follow_files(staged_->path(), run, route_, settings, matches_.matches());
  vo::write_file(staged_->path() / "report.html", record_.page(route_, run.walk));
  staged_->commit(kStaleFiles);
}

}  // namespace retrace
