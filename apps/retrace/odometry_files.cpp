#include "odometry_files.hpp"

#include "json_file.hpp"
#include "report/alignment_data.hpp"
#include "report/odometry_report.hpp"
#include "report/run_data.hpp"
#include "run_directory.hpp"
#include "settings_file.hpp"
#include "visual_odometry.hpp"

#include <algorithm>
#include <array>
#include <map>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <place/version.hpp>
#include <vo/base/degrees.hpp>
#include <vo/io/atomic_file.hpp>
#include <vo/io/csv_columns.hpp>
#include <vo/io/trajectory_io.hpp>

namespace retrace {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

/// The unit of displacements: without steps, visual odometry has its own unit, and alignment error has
/// seconds at mean speed.
std::string_view unit_of(const vo::Walk& walk, const vo::WalkMotion& motion) {
  if (motion.metric) return "m";
  return walk.track ? "units" : "s";
}

/// A single source's displacement of a frame, in its own unit.
struct Told {
  std::optional<double> displacement;
  int unit = 0;
};

/// The same with all frames of one unit scaled to the length that `motion` has over them.
std::vector<std::optional<double>> to_common_unit(const std::vector<Told>& told,
                                                  const vo::WalkMotion& motion) {
  std::map<int, std::pair<double, double>> lengths;  // for each unit: the source's length, and `motion`'s
  for (std::size_t i = 0; i < told.size(); ++i) {
    if (!told[i].displacement) continue;
    auto& [own, common] = lengths[told[i].unit];
    own += *told[i].displacement;
    common += motion.frames[i].value;
  }
  std::vector<std::optional<double>> displacement;
  for (const Told& frame : told) {
    const auto& [own, common] = lengths[frame.unit];
    const bool known = frame.displacement && own > 0;
    displacement.push_back(known ? std::optional(*frame.displacement * common / own) : std::nullopt);
  }
  return displacement;
}

/// The same with its jumps of scale left in: everything in the unit that most frames are in, scaled as above.
std::vector<std::optional<double>> to_one_unit(const std::vector<Told>& told, const vo::WalkMotion& motion) {
  std::map<int, std::vector<std::size_t>> frames;
  for (std::size_t i = 0; i < told.size(); ++i) {
    if (told[i].displacement) frames[told[i].unit].push_back(i);
  }
  std::vector<std::optional<double>> displacement(told.size());
  if (frames.empty()) return displacement;
  const auto most = std::ranges::max_element(frames, {}, [](const auto& unit) { return unit.second.size(); });
  double own = 0, common = 0;
  for (const std::size_t i : most->second) {
    own += *told[i].displacement;
    common += motion.frames[i].value;
  }
  for (std::size_t i = 0; i < told.size() && own > 0; ++i) {
    if (told[i].displacement) displacement[i] = *told[i].displacement * common / own;
  }
  return displacement;
}

std::string six(double value) {
  return fmt::format("{:.6f}", value);
}
std::string six_or_empty(const std::optional<double>& value) {
  return value ? six(*value) : std::string();
}

/// A row of frames.csv.
struct FrameRow {
  std::size_t frame = 0;
  double time_s = 0;
  vo::FrameDisplacement moved;
  std::string_view unit;
  vo::FrameMotion tracked;
  double heading_rad = 0, signal = 0, threshold = 0;
  bool reliable = false;
  vo::Pose2 pose;
  std::optional<double> vo_displacement, sad_displacement, vo_as_it_comes;
};

using F = FrameRow;
constexpr std::array kFrameColumns{
    vo::CsvColumn<F>{"frame", [](const F& r) { return std::to_string(r.frame); }},
    vo::CsvColumn<F>{"time_s", [](const F& r) { return six(r.time_s); }},
    vo::CsvColumn<F>{"displacement", [](const F& r) { return six(r.moved.value); }},
    vo::CsvColumn<F>{"unit", [](const F& r) { return std::string(r.unit); }},
    vo::CsvColumn<F>{"source", [](const F& r) { return std::string(vo::name_of(r.moved.source)); }},
    vo::CsvColumn<F>{"orientation_deg", [](const F& r) { return six_or_empty(r.tracked.orientation_deg); }},
    vo::CsvColumn<F>{"dx_px", [](const F& r) { return six_or_empty(r.tracked.shift_px); }},
    vo::CsvColumn<F>{"matches", [](const F& r) { return std::to_string(r.tracked.matches); }},
    vo::CsvColumn<F>{"heading_deg", [](const F& r) { return six(r.heading_rad * vo::kDegPerRad); }},
    vo::CsvColumn<F>{"step_signal", [](const F& r) { return six(r.signal); }},
    vo::CsvColumn<F>{"step_threshold", [](const F& r) { return six(r.threshold); }},
    vo::CsvColumn<F>{"reliable", [](const F& r) { return std::string(r.reliable ? "1" : "0"); }},
    vo::CsvColumn<F>{"x_m", [](const F& r) { return six(r.pose.x_m); }},
    vo::CsvColumn<F>{"y_m", [](const F& r) { return six(r.pose.y_m); }},
    vo::CsvColumn<F>{"displacement_sigma", [](const F& r) { return six(r.moved.sigma); }},
    vo::CsvColumn<F>{"vo_displacement", [](const F& r) { return six_or_empty(r.vo_displacement); }},
    vo::CsvColumn<F>{"sad_displacement", [](const F& r) { return six_or_empty(r.sad_displacement); }},
    vo::CsvColumn<F>{"vo_as_it_comes", [](const F& r) { return six_or_empty(r.vo_as_it_comes); }},
};

std::string frames_csv(const vo::Walk& walk, const vo::WalkMotion& motion) {
  std::vector<Told> by_vo(walk.frames()), by_sad(walk.frames());
  for (std::size_t i = 0; i < walk.frames(); ++i) {
    if (walk.track && walk.track->frames[i].valid)
      by_vo[i] = {walk.track->frames[i].displacement, walk.track->frames[i].segment};
    if (motion.visual) by_sad[i] = {motion.visual->displacement[i]};
  }
  const auto vo_displacement = to_common_unit(by_vo, motion),
             sad_displacement = to_common_unit(by_sad, motion), vo_as_it_comes = to_one_unit(by_vo, motion);
  const vo::PedestrianMotion& gait = *motion.pedestrian;
  const vo::Signal& signal = gait.signal.*vo::reader_of(gait.step_signal).values;
  std::vector<FrameRow> rows;
  for (std::size_t i = 0; i < walk.frames(); ++i) {
    rows.push_back({.frame = i,
                    .time_s = walk.time_s[i],
                    .moved = motion.frames[i],
                    .unit = unit_of(walk, motion),
                    .tracked = walk.tracked[i],
                    .heading_rad = gait.signal.heading_rad[i],
                    .signal = signal.values[i],
                    .threshold = gait.detection.delta_dyn[i],
                    .reliable = gait.signal.reliable[i],
                    .pose = motion.trajectory[i].pose,
                    .vo_displacement = vo_displacement[i],
                    .sad_displacement = sad_displacement[i],
                    .vo_as_it_comes = vo_as_it_comes[i]});
  }
  return vo::to_csv<FrameRow>(rows, kFrameColumns);
}

/// A row of steps.csv.
struct StepRow {
  std::size_t number = 0;
  vo::Step step;
  vo::Pose2 pose;
  double heading_rad = 0, length_m = 0;
};

using S = StepRow;
constexpr std::array kStepColumns{
    vo::CsvColumn<S>{"step", [](const S& r) { return std::to_string(r.number); }},
    vo::CsvColumn<S>{"frame", [](const S& r) { return std::to_string(r.step.frame); }},
    vo::CsvColumn<S>{"time_s", [](const S& r) { return six(r.step.time_s); }},
    vo::CsvColumn<S>{"leg",
                     [](const S& r) { return std::string(r.step.leg == vo::Leg::kLeft ? "left" : "right"); }},
    vo::CsvColumn<S>{"x_m", [](const S& r) { return six(r.pose.x_m); }},
    vo::CsvColumn<S>{"y_m", [](const S& r) { return six(r.pose.y_m); }},
    vo::CsvColumn<S>{"heading_deg", [](const S& r) { return six(r.heading_rad * vo::kDegPerRad); }},
    vo::CsvColumn<S>{"length_m", [](const S& r) { return six(r.length_m); }},
    vo::CsvColumn<S>{"bridged", [](const S& r) { return std::string(r.step.bridged ? "1" : "0"); }},
};

std::string steps_csv(const vo::WalkMotion& motion) {
  const vo::PedestrianMotion& gait = *motion.pedestrian;
  std::vector<StepRow> rows;
  for (std::size_t i = 0; i < gait.detection.steps.size(); ++i) {
    const vo::Step& step = gait.detection.steps[i];
    rows.push_back({i + 1, step, motion.trajectory[step.frame].pose, gait.trajectory.at_step[i].heading_rad,
                    gait.step_length_m[i]});
  }
  return vo::to_csv<StepRow>(rows, kStepColumns);
}

using A = vo::ActivitySecond;
constexpr std::array kActivityColumns{
    vo::CsvColumn<A>{"time_s", [](const A& r) { return fmt::format("{:.3f}", r.time_s); }},
    vo::CsvColumn<A>{"activity", [](const A& r) { return std::string(vo::name_of(r.activity)); }},
    vo::CsvColumn<A>{"amplitude_deg", [](const A& r) { return six(r.amplitude_deg); }},
    vo::CsvColumn<A>{"step_hz", [](const A& r) { return fmt::format("{:.4f}", r.step_hz); }},
};

ordered_json summary(const vo::Walk& walk, const vo::WalkMotion& walked, double step_length_m) {
  const vo::PedestrianMotion& motion = *walked.pedestrian;
  const vo::StepReader& reader = vo::reader_of(motion.step_signal);
  double distance = 0;
  std::map<std::string, std::size_t> sources;
  for (const vo::FrameDisplacement& frame : walked.frames) {
    distance += frame.value;
    if (frame.source != vo::DisplacementSource::kNone) ++sources[std::string(vo::name_of(frame.source))];
  }
  std::vector<std::string> warnings = walk.warnings;
  warnings.insert(warnings.end(), walked.warnings.begin(), walked.warnings.end());
  ordered_json json{
      {"walk", walk.source},
      {"frames", walk.frames()},
      {"duration_s", walk.time_s.back()},
      {"steps", motion.detection.steps.size()},
      {"step_signal", std::string(reader.name)},
      {"step_signal_unit", fmt::format("{} a frame", vo::name_of((motion.signal.*reader.values).unit))},
      {"steps_bridged", motion.detection.bridged},
      {"frames_bridged", motion.signal.bridged},
      {"step_length_m", step_length_m},
      {"distance", distance},
      {"unit", unit_of(walk, walked)},
      {"distance_m", nullptr},
      {"frames_by_source", sources},
      {"delta_min", nullptr},
      {"warnings", warnings},
      {"version", place::kVersion}};
  for (const vo::Activity activity : {vo::Activity::kStanding, vo::Activity::kWalking, vo::Activity::kRunning,
                                      vo::Activity::kRiding, vo::Activity::kUnknown}) {
    json["activity_s"][std::string(vo::name_of(activity))] =
        std::ranges::count(motion.activity, activity, &vo::ActivitySecond::activity);
  }
  if (walked.metric) json["distance_m"] = distance;
  if (motion.detection.delta_min) json["delta_min"] = *motion.detection.delta_min;
  return json;
}

}  // namespace

const std::vector<std::string> kOdometryFiles{
    "frames.csv",         "steps.csv",   "activity.csv", "trajectory.tum", "trajectory_odometry.tum",
    "summary.json",       "report.html", "config.toml",  kRunDataFile,     "visual_odometry.csv",
    "visual_odometry.tum"};

WrittenOdometry write_odometry(const fs::path& folder, const vo::Walk& walk, const vo::WalkMotion& walked,
                               const place::Settings& settings, const OdometryExtras& extras) {
  StagedFiles staged(folder);
  const fs::path& files = staged.path();
  ordered_json json = summary(walk, walked, settings.step_length.value_or(0));
  vo::Trajectory trajectory = walked.trajectory;
  if (extras.imu_steps) json["imu_steps"] = *extras.imu_steps;
  if (extras.loops != nullptr) {
    json["loops"] = {{"keyframes", extras.loops->loops}, {"believed", extras.loops->believed}};
    trajectory = extras.loops->trajectory;
    vo::write_file(files / "trajectory_odometry.tum",
                   vo::to_tum(walked.trajectory, "the same before loops were closed"));
  }
  vo::write_file(files / "frames.csv", frames_csv(walk, walked));
  vo::write_file(files / "steps.csv", steps_csv(walked));
  vo::write_file(files / "activity.csv",
                 vo::to_csv<vo::ActivitySecond>(walked.pedestrian->activity, kActivityColumns));
  vo::write_file(files / "trajectory.tum",
                 vo::to_tum(trajectory, fmt::format("pose of each frame since the first, {} and radians",
                                                    walked.metric ? "metres" : "units of no known length")));
  if (extras.visual_odometry) write_visual_odometry(walk, files);
  std::string text = json_text(json, 2) + "\n";
  vo::write_file(files / "summary.json", text);
  vo::write_file(files / "config.toml", to_toml(settings));
  vo::write_file(files / kRunDataFile,
                 ordered_json{{"alignment", alignment_data(walk, walked.visual, extras.visual)}}.dump());
  vo::write_file(files / "report.html", odometry_report(files));
  std::vector<std::string> stale{"odometry_metrics.json"};  // of other steps
  stale.insert(stale.end(), kOdometryFiles.begin(), kOdometryFiles.end());
  staged.commit(stale);
  return {json["distance"].get<double>(), json["unit"].get<std::string>(), std::move(text)};
}

}  // namespace retrace
