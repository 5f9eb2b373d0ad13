#include "visual_odometry.hpp"

#include <algorithm>
#include <map>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include <place/evaluation/kitti_evaluation.hpp>
#include <vo/base/error.hpp>
#include <vo/io/atomic_file.hpp>
#include <vo/io/csv.hpp>
#include <vo/io/pose_series_io.hpp>
#include <vo/motion/external_trajectory.hpp>

namespace retrace {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

constexpr double kScaledBy_m = 50;
constexpr const char* kCsv = "visual_odometry.csv";
constexpr const char* kTum = "visual_odometry.tum";

/// The poses of the segment with most frames.
std::vector<std::optional<vo::Pose3>> longest_segment(const fs::path& folder) {
  const vo::CsvTable table = vo::CsvTable::read(folder / kCsv);
  const std::vector<std::int64_t> segment = table.indices("segment");
  std::map<std::int64_t, std::size_t> frames;
  for (const std::int64_t s : segment) ++frames[s];
  if (frames.empty()) throw vo::Error((folder / kCsv).string(), "has no rows", "one for each frame");
  const auto longest = std::ranges::max_element(frames, {}, [](const auto& entry) { return entry.second; });
  // The same microseconds are in both files.
  const vo::DisplacementTrack track =
      vo::external_trajectory(vo::read_pose_series(folder / kTum), table.numbers("time_s"),
                              {.time_tolerance_s = 1e-6, .max_gap_s = 0, .metric = false});
  std::vector<std::optional<vo::Pose3>> poses = track.poses;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    if (segment[i] != longest->first) poses[i].reset();
  }
  return poses;
}

}  // namespace

void write_visual_odometry(const vo::Walk& walk, const fs::path& folder) {
  const vo::DisplacementTrack& track = *walk.track;
  std::string csv = "frame,time_s,valid,displacement,sigma,turn_deg,segment,loss\n";
  for (std::size_t i = 0; i < track.size(); ++i) {
    const vo::TrackedDisplacement& frame = track.frames[i];
    csv += fmt::format("{},{:.6f},{},", i, walk.time_s[i], frame.valid ? 1 : 0);
    if (frame.valid)
      csv += fmt::format("{:.9f},{:.9f},", frame.displacement, frame.sigma);
    else
      csv += ",,";
    if (frame.turn_rad) csv += fmt::format("{:.6f}", *frame.turn_rad * 180 / std::numbers::pi);
    csv += fmt::format(",{},{}\n", frame.segment, vo::name_of(frame.loss));
  }
  vo::write_file(folder / kCsv, csv);
  vo::write_file(folder / kTum,
                 vo::to_tum(track.poses, walk.time_s,
                            "camera (x right, y down, z forward); each segment has its own origin and unit"));
}

ordered_json kitti_metrics(const fs::path& folder, const fs::path& kitti_poses) {
  const vo::PoseSeries truth = vo::read_pose_series(kitti_poses);
  std::vector<std::optional<vo::Pose3>> estimate = longest_segment(folder);
  if (truth.poses.size() != estimate.size()) {
    throw vo::Error(kitti_poses.string(), fmt::format("has {} poses", truth.poses.size()),
                    fmt::format("{}, one for each frame of the walk", estimate.size()));
  }
  const std::optional<double> metres = place::metres_per_unit(truth.poses, estimate, kScaledBy_m);
  if (!metres) {
    throw vo::Error((folder / kTum).string(), fmt::format("is lost within {} m", kScaledBy_m),
                    "poses over them, to take the scale from");
  }
  for (std::optional<vo::Pose3>& pose : estimate) {
    if (pose) pose->position *= *metres;
  }
  const place::KittiEvaluation evaluation = place::evaluate_kitti(truth.poses, estimate);
  const auto json_of = [](const place::KittiErrors& errors) {
    return ordered_json{{"stretches", errors.stretches},
                        {"translation_pct", errors.translation_pct},
                        {"rotation_deg_per_m", errors.rotation_deg_per_m}};
  };
  ordered_json json{{"frames", estimate.size()},
                    {"frames_with_pose", std::ranges::count_if(estimate, [](const auto& p) { return !!p; })},
                    {"metres_per_unit", *metres},
                    {"scaled_by_first_m", kScaledBy_m},
                    {"stretches_unknown", evaluation.unknown},
                    {"all", json_of(evaluation.all)}};
  for (const place::KittiErrors& errors : evaluation.by_length) {
    if (errors.stretches > 0) json["by_length_m"][fmt::format("{}", errors.length_m)] = json_of(errors);
  }
  return json;
}

void print_kitti_metrics(const ordered_json& metrics) {
  fmt::print("{:>8} {:>10} {:>14} {:>15}\n", "length m", "stretches", "translation %", "rotation deg/m");
  const auto row = [](const std::string& name, const ordered_json& errors) {
    fmt::print("{:>8} {:>10} {:>14.2f} {:>15.4f}\n", name, errors["stretches"].get<std::size_t>(),
               errors["translation_pct"].get<double>(), errors["rotation_deg_per_m"].get<double>());
  };
  if (metrics.contains("by_length_m")) {
    for (const auto& [length, errors] : metrics["by_length_m"].items()) row(length, errors);
  }
  row("all", metrics["all"]);
}

}  // namespace retrace
