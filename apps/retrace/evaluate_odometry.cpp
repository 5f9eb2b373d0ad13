#include "command.hpp"
#include "odometry_evaluation_files.hpp"
#include "report/odometry_report.hpp"
#include "visual_odometry.hpp"

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <place/evaluation/odometry_evaluation.hpp>
#include <vo/base/error.hpp>
#include <vo/io/atomic_file.hpp>
#include <vo/io/csv.hpp>
#include <vo/io/trajectory_io.hpp>

namespace retrace {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

struct EvaluateOdometryOptions {
  CommonOptions common;
  std::vector<std::string> folders;  ///< written by `retrace odometry`
  std::string kitti_poses;
  std::vector<std::string> truths;  ///< for each: truth.csv, or a path on a map
  std::optional<double> map_scale_m_per_px;
  std::string map_image;
  std::vector<std::size_t> true_steps;  ///< for each, or none
  std::string output;                   ///< folder for the errors over all walks together
  place::OdometryEvaluationOptions evaluation;
};

void evaluate_kitti(const EvaluateOdometryOptions& options) {
  const fs::path folder = options.folders.front();
  const ordered_json metrics = kitti_metrics(folder, options.kitti_poses);
  vo::write_file(folder / "kitti_metrics.json", metrics.dump(2) + "\n");
  if (options.common.json)
    fmt::print("{}\n", metrics.dump(2));
  else
    print_kitti_metrics(metrics);
}

/// Measures the walk of a folder, and writes its metrics and report there.
OdometryMeasured measure(const EvaluateOdometryOptions& options, std::size_t walk) {
  const fs::path folder = options.folders[walk];
  check_metres(folder);
  std::optional<std::size_t> counted;
  if (!options.true_steps.empty()) counted = options.true_steps[walk];
  const WalkTruth truth = read_walk_truth(options.truths[walk], options.map_scale_m_per_px, counted);
  OdometryMeasured measured{.steps = vo::CsvTable::read(folder / "steps.csv").rows()};
  if (truth.steps) measured.counted = {{measured.steps, *truth.steps}};
  const vo::Trajectory trajectory = vo::read_tum(folder / "trajectory.tum");
  const auto pairs = truth.way.empty()
                         ? place::pair_by_time(truth.walk.poses, truth.walk.distance_m, trajectory)
                         : place::pair_by_share(truth.way, trajectory);
  place::OdometryEvaluationOptions evaluation = options.evaluation;
  evaluation.seed += walk;  // other starts on each walk
  measured.evaluation = place::evaluate_odometry(pairs, evaluation);
  if (measured.evaluation.segment_m == 0) {
    throw vo::Error(options.truths[walk],
                    fmt::format("and the trajectory share {:.1f} m", measured.evaluation.distance_m),
                    fmt::format("{} m or more", options.evaluation.at_m.front()));
  }
  vo::write_file(folder / "odometry_metrics.json",
                 odometry_metrics_json(measured, evaluation).dump(2) + "\n");
  const OdometryTruth for_report{.poses = truth.walk.poses,
                                 .way = truth.way,
                                 .map_image = options.map_image,
                                 .map_scale_m_per_px = options.map_scale_m_per_px.value_or(0),
                                 .steps = truth.steps ? std::to_string(*truth.steps) : "",
                                 .evaluation = measured.evaluation};
  vo::write_file(folder / "report.html", odometry_report(folder, &for_report));
  return measured;
}

void check_counts(const EvaluateOdometryOptions& options) {
  const std::size_t walks = options.folders.size();
  if (!options.kitti_poses.empty() && walks > 1)
    throw vo::Error("--kitti-poses", fmt::format("is of one walk and {} are given", walks), "one folder");
  if (options.kitti_poses.empty() && options.truths.size() != walks)
    throw vo::Error("--truth", fmt::format("names {} files for {} walks", options.truths.size(), walks),
                    "one for each, in their order");
  if (!options.true_steps.empty() && options.true_steps.size() != walks)
    throw vo::Error("--true-steps",
                    fmt::format("has {} numbers for {} walks", options.true_steps.size(), walks),
                    "one for each, in their order");
  if (!options.output.empty() && walks < 2)
    throw vo::Error("--output", "is for several walks", "more walks, or this left out");
  for (const std::string& folder : options.folders)
    if (!fs::is_directory(folder))
      throw vo::Error(folder, "is no folder", "one written by `retrace odometry`");
}

void evaluate_odometry(const EvaluateOdometryOptions& options) {
  check_counts(options);
  if (!options.kitti_poses.empty()) return evaluate_kitti(options);
  std::vector<OdometryMeasured> walks;
  for (std::size_t i = 0; i < options.folders.size(); ++i) walks.push_back(measure(options, i));
  const OdometryMeasured all = pooled(walks);
  const std::string metrics = odometry_metrics_json(all, options.evaluation).dump(2) + "\n";
  if (!options.output.empty()) {
    fs::create_directories(options.output);
    vo::write_file(fs::path(options.output) / "odometry_metrics.json", metrics);
  }
  if (options.common.json) {
    fmt::print("{}", metrics);
    return;
  }
  print_odometry_metrics(all);
  for (const std::string& folder : options.folders)
    fmt::print("see {}\n", (fs::path(folder) / "report.html").string());
}

}  // namespace

std::function<void()> declare_evaluate_odometry(Arguments& arguments) {
  auto options = std::make_shared<EvaluateOdometryOptions>();
  place::OdometryEvaluationOptions& evaluation = options->evaluation;
  arguments.positional("run", options->folders,
                       "folders written by `retrace odometry`, of one walk or several");
  const Argument truth = arguments.option(
      "--truth", options->truths,
      "of each walk: truth.csv, or the way as a line on a map: x_px,y_px, y downwards, north up");
  const Argument kitti = arguments.option(
      "--kitti-poses", options->kitti_poses,
      "true poses in KITTI's form: its errors of visual odometry alone, which `retrace odometry "
      "--visual-odometry` wrote");
  arguments.exactly_one({truth, kitti});
  Argument scale = arguments.option("--map-scale-m-per-px", options->map_scale_m_per_px,
                                    "metres of one pixel of that map");
  scale.positive();
  arguments.option("--map-image", options->map_image, "that map, PNG or JPEG, to draw the trajectory over")
      .existing_file()
      .needs(scale);
  arguments.option("--true-steps", options->true_steps,
                   "steps counted on each walk, where the truth has none");
  arguments.option("-o,--output", options->output,
                   "folder for odometry_metrics.json of several walks together [PVO 5.4]");
  arguments.option("--segments", evaluation.segments, "random segments measured [PVO 5.2]").range(1, 1e6);
  arguments
      .option("--segment-m", evaluation.segment_m, "metres of a segment [PVO 5.2: 50 indoors, 100 outdoors]")
      .range(5, 1e6);
  arguments.option("--seed", evaluation.seed, "of the segments' starts");
  arguments.json(options->common);
  arguments.footer(
      "Examples:\n"
      "  retrace evaluate-odometry walk --truth truth.csv\n"
      "  retrace evaluate-odometry walk1 walk2 --truth truth1.csv truth2.csv -o all\n"
      "  retrace evaluate-odometry walk --truth way.csv --map-scale-m-per-px 0.2 --true-steps 512 "
      "--segment-m 50\n"
      "  retrace evaluate-odometry drive --kitti-poses 03.txt");
  return [options] { evaluate_odometry(*options); };
}

}  // namespace retrace
