#include "command.hpp"
#include "comparison.hpp"
#include "json_file.hpp"
#include "report/compare_report.hpp"
#include "run_directory.hpp"

#include <filesystem>
#include <memory>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <vo/base/error.hpp>
#include <vo/base/parallel.hpp>
#include <vo/io/atomic_file.hpp>

namespace retrace {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

struct CompareOptions {
  CommonOptions common;
  std::vector<std::string> folders;
  std::vector<std::string> names;
  std::string output;
  place::BootstrapOptions bootstrap;
  int threads = 0;
};

void compare(const CompareOptions& options) {
  vo::set_thread_count(options.threads);
  if (!options.names.empty() && options.names.size() != options.folders.size())
    throw vo::Error("--names", fmt::format("has {} names", options.names.size()),
                    fmt::format("{}, one for each run", options.folders.size()));
  const fs::path folder = options.output;
  prepare_run_directory(folder, {"comparison.json", "report.html"}, options.common.force);
  const Comparison comparison = compare_runs(options.folders, options.names, options.bootstrap);
  const ordered_json json = comparison_json(comparison);
  StagedFiles staged(folder);
  vo::write_file(staged.path() / "comparison.json", json_text(json, 2) + "\n");
  vo::write_file(staged.path() / "report.html", compare_report(comparison));
  staged.commit();
  if (options.common.json) {
    fmt::print("{}\n", json_text(json, 2));
    return;
  }
  fmt::print("  {:<20} {:<23} {:<23} {:<23}\n", "run", "max-F1", "area under the curve", "recall at 100 %");
  for (const ComparedRun& run : comparison.runs) {
    fmt::print("  {:<20} {:<23} {:<23} {:<23}\n", run.name,
               with_interval(run.evaluation.best.f1, run.bootstrap.max_f1),
               with_interval(run.evaluation.auc_pr, run.bootstrap.auc_pr),
               with_interval(run.evaluation.recall_at_100_precision, run.bootstrap.recall_at_100_precision));
  }
  for (const ordered_json& d : json["differences"]) {
    fmt::print("{} against {}: {:+.3f}, above 0 in {:.1f} % of the resamples\n", d["run"].get<std::string>(),
               d["other"].get<std::string>(), d["max_f1_difference"].get<double>(),
               100 * d["share_above_0"].get<double>());
  }
  fmt::print("see {}\n", (folder / "report.html").string());
}

}  // namespace

std::function<void()> declare_compare(Arguments& arguments) {
  auto options = std::make_shared<CompareOptions>();
  place::BootstrapOptions& bootstrap = options->bootstrap;
  arguments.positional("runs", options->folders, "folders of evaluated runs, two or more").count(2, 1000);
  arguments.option("-o,--output", options->output, "folder for the results").required();
  arguments.option("--names", options->names, "names of the runs, comma between [their folders']")
      .comma_separated();
  arguments
      .option("--segment-s", bootstrap.segment_s,
              "seconds of walk that are drawn as a whole: neighbours are not independent")
      .positive();
  arguments.option("--resamples", bootstrap.resamples, "bootstrap resamples").range(1, 1e7);
  arguments.option("--confidence", bootstrap.confidence, "share of the resamples an interval holds")
      .range(0.01, 0.9999);
  arguments.option("--seed", bootstrap.seed, "of the resamples");
  arguments.option("--threads", options->threads, "threads, 0 for one per core; results do not depend on it")
      .range(0, 1024);
  arguments.common(options->common);
  arguments.footer(
      "Examples:\n"
      "  retrace compare vanilla normalised -o comparison\n"
      "  retrace compare a/run b/run --names every-12th,by-motion -o comparison --segment-s 20");
  return [options] { compare(*options); };
}

}  // namespace retrace
