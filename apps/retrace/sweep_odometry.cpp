#include "command.hpp"
#include "odometry_arguments.hpp"
#include "odometry_sweep_table.hpp"
#include "progress_bar.hpp"
#include "run_directory.hpp"

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>

#include <place/evaluation/odometry_sweep.hpp>
#include <vo/base/parallel.hpp>
#include <vo/io/atomic_file.hpp>

namespace retrace {
namespace {

namespace fs = std::filesystem;

constexpr const char* kFile = "odometry_sweep.csv";

struct SweepOdometryOptions {
  place::Settings settings;
  CommonOptions common;
  std::vector<std::string> walks, truths;
  std::string vary = "tracking-window=1,2,3,4,5";
  std::string output;
  place::OdometryEvaluationOptions evaluation;
};

void sweep_odometry(const SweepOdometryOptions& options) {
  vo::set_thread_count(options.settings.threads.value_or(0));
  check_one_for_each("--truth", options.truths.size(), options.walks.size());
  const place::SweepAxis axis = place::parse_axis(options.vary);
  std::vector<place::OdometrySweepRow> rows;
  prepare_run_directory(options.output, {kFile}, options.common.force);
  {
    ProgressBar bar;
    std::vector<place::OdometrySweepWalk> walks;
    for (std::size_t i = 0; i < options.walks.size(); ++i) {
      const std::string& source = options.walks[i];
      walks.push_back(
          {.name = source,
           .read = [&bar, &source](
                       const vo::WalkOptions& walk) { return vo::read_walk(source, walk, bar.callback()); },
           .truth = vo::read_truth(options.truths[i])});
    }
    rows = place::sweep_odometry(walks, options.settings, axis, options.evaluation);
  }
  vo::write_file(fs::path(options.output) / kFile, odometry_sweep_csv(axis.setting, rows));
  fmt::print("{}", odometry_sweep_table(axis.setting, rows));
  fmt::print("see {}\n", (fs::path(options.output) / kFile).string());
}

}  // namespace

std::function<void()> declare_sweep_odometry(Arguments& arguments) {
  auto options = std::make_shared<SweepOdometryOptions>();
  arguments.positional("walks", options->walks, "video files or folders of images, a walk each");
  arguments.option("--truth", options->truths, "truth.csv of each walk").required();
  arguments.option("-o,--output", options->output, "folder for odometry_sweep.csv").required();
  arguments.option(
      "--vary", options->vary,
      "NAME=a,b,c: a setting of reading, motion or odometry; the first value is what the others are "
      "compared with");
  declare_segments(arguments, options->evaluation, "random segments of each walk");
  declare_odometry_settings(arguments, options->settings, {"motion-file-unit"});
  arguments.force(options->common);
  arguments.footer(
      "PVO Table 1: E-P and E-STD are by how many percent the mean position error and its deviation are "
      "smaller than "
      "with the\nfirst value, H-D and H-STD by how many degrees the mean heading error and its deviation "
      "differ, negative "
      "where smaller.\nExample:\n"
      "  retrace sweep-odometry one.mp4 two.mp4 --truth one.csv two.csv -o table1 --config configs/pvo.toml");
  return [options] { sweep_odometry(*options); };
}

}  // namespace retrace
