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
  std::string folder;  ///< written by `retrace odometry`
  std::string kitti_poses;
  std::string truth;  ///< truth.csv, or a way on a map
  std::optional<double> map_scale_m_per_px;
  std::string map_image;
  std::optional<std::size_t> true_steps;
  place::OdometryEvaluationOptions evaluation;
};

void evaluate_kitti(const EvaluateOdometryOptions& options) {
  const fs::path folder = options.folder;
  const ordered_json metrics = kitti_metrics(folder, options.kitti_poses);
  vo::write_file(folder / "kitti_metrics.json", metrics.dump(2) + "\n");
  if (options.common.json)
    fmt::print("{}\n", metrics.dump(2));
  else
    print_kitti_metrics(metrics);
}

void evaluate_odometry(const EvaluateOdometryOptions& options) {
  const fs::path folder = options.folder;
  if (!fs::is_directory(folder))
    throw vo::Error(options.folder, "is no folder", "one written by `retrace odometry`");
  if (!options.kitti_poses.empty()) return evaluate_kitti(options);
  check_metres(folder);
  const std::size_t steps = vo::CsvTable::read(folder / "steps.csv").rows();
  const vo::Trajectory trajectory = vo::read_tum(folder / "trajectory.tum");
  const WalkTruth truth = read_walk_truth(options.truth, options.map_scale_m_per_px, options.true_steps);
  const auto pairs = truth.way.empty()
                         ? place::pair_by_time(truth.walk.poses, truth.walk.distance_m, trajectory)
                         : place::pair_by_share(truth.way, trajectory);
  const place::OdometryEvaluation evaluation = place::evaluate_odometry(pairs, options.evaluation);
  if (evaluation.segment_m == 0) {
    throw vo::Error(options.truth, fmt::format("and the trajectory share {:.1f} m", evaluation.distance_m),
                    fmt::format("{} m or more", options.evaluation.at_m.front()));
  }
  const ordered_json metrics = odometry_metrics_json(steps, truth.steps, evaluation, options.evaluation);
  vo::write_file(folder / "odometry_metrics.json", metrics.dump(2) + "\n");
  const OdometryTruth for_report{.poses = truth.walk.poses,
                                 .way = truth.way,
                                 .map_image = options.map_image,
                                 .map_scale_m_per_px = options.map_scale_m_per_px.value_or(0),
                                 .steps = truth.steps ? std::to_string(*truth.steps) : "",
                                 .evaluation = evaluation};
  vo::write_file(folder / "report.html", odometry_report(folder, &for_report));
  if (options.common.json) {
    fmt::print("{}\n", metrics.dump(2));
    return;
  }
  print_odometry_metrics(steps, truth.steps, evaluation);
  fmt::print("see {}\n", (folder / "report.html").string());
}

}  // namespace

std::function<void()> declare_evaluate_odometry(Arguments& arguments) {
  auto options = std::make_shared<EvaluateOdometryOptions>();
  place::OdometryEvaluationOptions& evaluation = options->evaluation;
  arguments.positional("run", options->folder, "folder written by `retrace odometry`");
  const Argument truth =
      arguments.option("--truth", options->truth,
                       "truth.csv, or the way as a line on a map: x_px,y_px, y downwards, north up");
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
  arguments.option("--true-steps", options->true_steps, "steps counted, where the truth has none");
  arguments.option("--segments", evaluation.segments, "random segments measured [PVO 5.2]").range(1, 1e6);
  arguments
      .option("--segment-m", evaluation.segment_m, "metres of a segment [PVO 5.2: 50 indoors, 100 outdoors]")
      .range(5, 1e6);
  arguments.option("--seed", evaluation.seed, "of the segments' starts");
  arguments.json(options->common);
  arguments.footer(
      "Examples:\n"
      "  retrace evaluate-odometry walk --truth truth.csv\n"
      "  retrace evaluate-odometry walk --truth way.csv --map-scale-m-per-px 0.2 --true-steps 512 "
      "--segment-m 50\n"
      "  retrace evaluate-odometry drive --kitti-poses 03.txt");
  return [options] { evaluate_odometry(*options); };
}

}  // namespace retrace
