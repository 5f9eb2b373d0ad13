#include "command.hpp"
#include "evaluation_files.hpp"
#include "report/compare_report.hpp"
#include "run_directory.hpp"

#include <algorithm>
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

/// The folders' own names, or their whole paths where two have one name.
std::vector<std::string> names_of(const CompareOptions& options) {
  if (!options.names.empty()) return options.names;
  std::vector<std::string> names;
  for (const std::string& folder : options.folders)
    names.push_back((fs::path(folder) / "").parent_path().filename().string());
  std::vector<std::string> sorted = names;
  std::ranges::sort(sorted);
  return std::ranges::adjacent_find(sorted) == sorted.end() ? names : options.folders;
}

Comparison compare_runs(const CompareOptions& options) {
  Comparison comparison{.options = options.bootstrap};
  const std::vector<std::string> names = names_of(options);
  std::vector<place::TimedQueries> queries;
  for (std::size_t i = 0; i < options.folders.size(); ++i) {
    const auto [tolerance, unit] = read_tolerance(options.folders[i]);
    if (i == 0) std::tie(comparison.tolerance, comparison.unit) = std::tie(tolerance, unit);
    if (tolerance != comparison.tolerance || unit != comparison.unit) {
      throw vo::Error(
          options.folders[i], fmt::format("was evaluated with a tolerance of {:g} {}", tolerance, unit),
          fmt::format("{:g} {}, as {}", comparison.tolerance, comparison.unit, options.folders[0]));
    }
    queries.push_back(read_errors(options.folders[i]));
    comparison.runs.push_back({.name = names[i],
                               .folder = options.folders[i],
                               .evaluation = place::evaluate(queries.back().queries, tolerance),
                               .bootstrap = {}});
  }
  auto bootstraps = place::bootstrap(queries, comparison.tolerance, options.bootstrap);
  for (std::size_t i = 0; i < bootstraps.size(); ++i) comparison.runs[i].bootstrap = std::move(bootstraps[i]);
  return comparison;
}

ordered_json interval_json(const std::optional<place::Interval>& interval) {
  return interval ? ordered_json{interval->low, interval->high} : ordered_json(nullptr);
}

ordered_json as_json(const Comparison& comparison) {
  ordered_json json{{"tolerance", comparison.tolerance},
                    {"unit", comparison.unit},
                    {"resamples", comparison.options.resamples},
                    {"segment_s", comparison.options.segment_s},
                    {"confidence", comparison.options.confidence},
                    {"seed", comparison.options.seed},
                    {"runs", ordered_json::array()},
                    {"differences", ordered_json::array()}};
  for (const ComparedRun& run : comparison.runs) {
    const place::Evaluation& e = run.evaluation;
    const place::RunBootstrap& b = run.bootstrap;
    json["runs"].push_back({{"name", run.name},
                            {"folder", run.folder},
                            {"with_truth", e.with_truth},
                            {"max_f1", e.best.f1},
                            {"max_f1_interval", interval_json(b.max_f1)},
                            {"auc_pr", e.auc_pr},
                            {"auc_pr_interval", interval_json(b.auc_pr)},
                            {"recall_at_100_precision", e.recall_at_100_precision},
                            {"recall_at_100_precision_interval", interval_json(b.recall_at_100_precision)},
                            {"recall_at_1", e.recall_at_1},
                            {"recall_at_1_interval", interval_json(b.recall_at_1)}});
  }
  for (std::size_t i = 0; i < comparison.runs.size(); ++i) {
    for (std::size_t k = i + 1; k < comparison.runs.size(); ++k) {
      const ComparedRun &run = comparison.runs[k], &other = comparison.runs[i];
      const auto difference =
          place::paired_difference(run.bootstrap, other.bootstrap, comparison.options.confidence);
      json["differences"].push_back({{"run", run.name},
                                     {"other", other.name},
                                     {"max_f1_difference", run.evaluation.best.f1 - other.evaluation.best.f1},
                                     {"interval", interval_json(difference.interval)},
                                     {"share_above_0", difference.share_above}});
    }
  }
  return json;
}

void compare(const CompareOptions& options) {
  vo::set_thread_count(options.threads);
  if (!options.names.empty() && options.names.size() != options.folders.size())
    throw vo::Error("--names", fmt::format("has {} names", options.names.size()),
                    fmt::format("{}, one for each run", options.folders.size()));
  const fs::path folder = options.output;
  prepare_run_directory(folder, {"comparison.json", "report.html"}, options.common.force);
  const Comparison comparison = compare_runs(options);
  const ordered_json json = as_json(comparison);
  vo::write_file(folder / "comparison.json", json.dump(2) + "\n");
  vo::write_file(folder / "report.html", compare_report(comparison));
  if (options.common.json) {
    fmt::print("{}\n", json.dump(2));
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
