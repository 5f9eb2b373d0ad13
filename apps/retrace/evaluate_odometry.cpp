#include "command.hpp"
#include "json_file.hpp"
#include "measured_odometry.hpp"
#include "odometry_arguments.hpp"
#include "odometry_truths.hpp"
#include "run_directory.hpp"
#include "visual_odometry.hpp"

#include <filesystem>
#include <memory>
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
  OdometryTruths truths;
  std::string output;  ///< folder for the errors over all walks together
  place::OdometryEvaluationOptions evaluation;
};

void evaluate_kitti(const EvaluateOdometryOptions& options) {
  const fs::path folder = options.folders.front();
  const ordered_json metrics = kitti_metrics(folder, options.truths.kitti_poses);
  vo::write_file(folder / "kitti_metrics.json", json_text(metrics, 2) + "\n");
  if (options.common.json)
    fmt::print("{}\n", json_text(metrics, 2));
  else
    print_kitti_metrics(metrics);
}

void evaluate_odometry(const EvaluateOdometryOptions& options) {
  const std::vector<WalkTruthOptions> truths = truth_of_each(options.truths, options.folders.size());
  if (!options.output.empty() && options.folders.size() < 2)
    throw vo::Error("--output", "is for several walks", "more walks, or this left out");
  for (const std::string& folder : options.folders) check_written_by("odometry", folder);
  if (!options.truths.kitti_poses.empty()) return evaluate_kitti(options);
  if (!options.output.empty()) prepare_run_directory(options.output, {}, true);
  std::vector<OdometryMeasured> walks;
  for (std::size_t i = 0; i < options.folders.size(); ++i) {
    place::OdometryEvaluationOptions evaluation = options.evaluation;
    evaluation.seed += i;  // other starts on each walk
    walks.push_back(measure_odometry(options.folders[i], truths[i], evaluation));
  }
  const OdometryMeasured all = pooled(walks);
  const std::string metrics = json_text(odometry_metrics_json(all, options.evaluation), 2) + "\n";
  if (!options.output.empty()) vo::write_file(fs::path(options.output) / "odometry_metrics.json", metrics);
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
  arguments.positional("run", options->folders,
                       "folders written by `retrace odometry`, of one walk or several");
  const Argument kitti = declare_odometry_truths(arguments, options->truths);
  arguments.option("-o,--output", options->output,
                   "folder for odometry_metrics.json of several walks together [PVO 5.4]");
  for (Argument& segments : declare_segments(arguments, options->evaluation, "random segments measured"))
    segments.excludes(kitti);  // whose lengths are KITTI's
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
