#include "command.hpp"
#include "progress_bar.hpp"
#include "run_directory.hpp"

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <place/evaluation/odometry_sweep.hpp>
#include <vo/base/error.hpp>
#include <vo/base/parallel.hpp>
#include <vo/io/atomic_file.hpp>

namespace retrace {
namespace {

namespace fs = std::filesystem;
using place::OdometrySweepRow;

constexpr const char* kFile = "odometry_sweep.csv";

struct SweepOdometryOptions {
  place::Settings settings;
  CommonOptions common;
  std::vector<std::string> walks, truths;
  std::string vary = "tracking-window=1,2,3,4,5";
  std::string output;
  place::OdometryEvaluationOptions evaluation;
};

/// One row for each value and distance that any walk reaches.
std::string sweep_csv(const std::string& setting, const std::vector<OdometrySweepRow>& rows) {
  std::string csv =
      setting +
      ",at_m,measurements,steps_estimated,step_error_pct,euclidean_error_m,euclidean_error_sd_m,"
      "heading_error_deg,heading_error_sd_deg,heading_absolute_error_deg,e_p_pct,e_std_pct,h_d_deg,"
      "h_std_deg\n";
  for (const OdometrySweepRow& row : rows) {
    for (std::size_t i = 0; i < row.evaluation.errors.size(); ++i) {
      const place::OdometryErrors& e = row.evaluation.errors[i];
      if (e.count == 0) continue;
      const place::OdometryImprovement better = place::improvement(e, rows.front().evaluation.errors[i]);
      csv += fmt::format(
          "{},{},{},{},{},{:.6f},{:.6f},{:.6f},{:.6f},{:.6f},{:.3f},{:.3f},{:.3f},{:.3f}\n", row.value,
          e.at_m, e.count, row.steps, row.step_errors ? fmt::format("{:.4f}", row.step_errors->pct) : "",
          e.euclidean_mean_m, e.euclidean_sd_m, e.heading_mean_deg, e.heading_sd_deg, e.heading_abs_mean_deg,
          better.euclidean_pct, better.euclidean_sd_pct, better.heading_deg, better.heading_sd_deg);
    }
  }
  return csv;
}

/// PVO Table 1: improvements over the first value, at 50 m and 100 m or, of shorter walks, the last distance.
void print_sweep(const std::string& setting, const std::vector<OdometrySweepRow>& rows) {
  const std::vector<place::OdometryErrors>& base = rows.front().evaluation.errors;
  fmt::print("{:>16} {:>5} {:>12} {:>16} {:>18} {:>7} {:>7} {:>7} {:>7}\n", setting, "at m", "measurements",
             "position m", "heading deg", "E-P", "E-STD", "H-D", "H-STD");
  for (std::size_t i = 0; i < base.size(); ++i) {
    const bool last = i + 1 == base.size() || base[i + 1].count == 0;
    if (base[i].count == 0 || (!last && base[i].at_m != 50)) continue;
    for (const OdometrySweepRow& row : rows) {
      const place::OdometryErrors& e = row.evaluation.errors[i];
      const place::OdometryImprovement better = place::improvement(e, base[i]);
      fmt::print("{:>16} {:>5} {:>12} {:>16} {:>18} {:>7.1f} {:>7.1f} {:>7.1f} {:>7.1f}\n", row.value, e.at_m,
                 e.count, fmt::format("{:.2f} +- {:.2f}", e.euclidean_mean_m, e.euclidean_sd_m),
                 fmt::format("{:.2f} +- {:.2f}", e.heading_mean_deg, e.heading_sd_deg), better.euclidean_pct,
                 better.euclidean_sd_pct, better.heading_deg, better.heading_sd_deg);
    }
  }
}

void sweep_odometry(const SweepOdometryOptions& options) {
  vo::set_thread_count(options.settings.threads.value_or(0));
  if (options.truths.size() != options.walks.size())
    throw vo::Error("--truth",
                    fmt::format("names {} files for {} walks", options.truths.size(), options.walks.size()),
                    "one for each, in their order");
  const place::SweepAxis axis = place::parse_axis(options.vary);
  std::vector<OdometrySweepRow> rows;
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
  vo::write_file(fs::path(options.output) / kFile, sweep_csv(axis.setting, rows));
  print_sweep(axis.setting, rows);
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
  arguments.option("--segments", options->evaluation.segments, "random segments of each walk [PVO 5.2]")
      .range(1, 1e6);
  arguments
      .option("--segment-m", options->evaluation.segment_m,
              "metres of a segment [PVO 5.2: 50 indoors, 100 "
              "outdoors]")
      .range(5, 1e6);
  arguments.option("--seed", options->evaluation.seed, "of the segments' starts");
  using enum place::SettingGroup;
  arguments.settings(options->settings, {kReading, kMotion, kOdometry, kGeneral},
                     {"every", "spacing-m", "sampling-n", "tie-scale", "motion-file", "motion-file-start-s",
                      "motion-file-gap-s", "motion-file-unit", "axes", "preview-width-px"});
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
