#include "command.hpp"
#include "json_file.hpp"
#include "measured_odometry.hpp"
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
  vo::write_file(folder / "kitti_metrics.json", json_text(metrics, 2) + "\n");
  if (options.common.json)
    fmt::print("{}\n", json_text(metrics, 2));
  else
    print_kitti_metrics(metrics);
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
  for (std::size_t i = 0; i < options.folders.size(); ++i) {
    WalkTruthOptions truth{.path = options.truths[i],
                           .map_scale_m_per_px = options.map_scale_m_per_px,
                           .map_image = options.map_image};
    if (!options.true_steps.empty()) truth.steps = options.true_steps[i];
    place::OdometryEvaluationOptions evaluation = options.evaluation;
    evaluation.seed += i;  // other starts on each walk
    walks.push_back(measure_odometry(options.folders[i], truth, evaluation));
  }
  const OdometryMeasured all = pooled(walks);
  const std::string metrics = json_text(odometry_metrics_json(all, options.evaluation), 2) + "\n";
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
      "of each walk: truth.csv, or the path as a line on a map: x_px,y_px, y downwards, north up");
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
      "  retrace evaluate-odometry walk --truth path.csv --map-scale-m-per-px 0.2 --true-steps 512 "
      "--segment-m 50\n"
      "  retrace evaluate-odometry drive --kitti-poses 03.txt");
  return [options] { evaluate_odometry(*options); };
}

}  // namespace retrace
