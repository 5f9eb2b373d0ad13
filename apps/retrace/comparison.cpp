#include "comparison.hpp"

#include "evaluation_files.hpp"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <vo/base/error.hpp>

namespace retrace {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

/// The folders' own names, or their whole paths if two share a name.
std::vector<std::string> names_of(const std::vector<std::string>& folders) {
  std::vector<std::string> names;
  for (const std::string& folder : folders)
    names.push_back((fs::path(folder) / "").parent_path().filename().string());
  std::vector<std::string> sorted = names;
  std::ranges::sort(sorted);
  return std::ranges::adjacent_find(sorted) == sorted.end() ? names : folders;
}

ordered_json interval_json(const std::optional<place::Interval>& interval) {
  return interval ? ordered_json{interval->low, interval->high} : ordered_json(nullptr);
}

}  // namespace

Comparison compare_runs(const std::vector<std::string>& folders, const std::vector<std::string>& given_names,
                        const place::BootstrapOptions& options) {
  Comparison comparison{.options = options};
  const std::vector<std::string> names = given_names.empty() ? names_of(folders) : given_names;
  std::vector<place::TimedQueries> queries;
  for (std::size_t i = 0; i < folders.size(); ++i) {
    const auto [tolerance, unit] = read_tolerance(folders[i]);
    if (i == 0) std::tie(comparison.tolerance, comparison.unit) = std::tie(tolerance, unit);
    if (tolerance != comparison.tolerance || unit != comparison.unit) {
      throw vo::Error(folders[i], fmt::format("was evaluated with a tolerance of {:g} {}", tolerance, unit),
                      fmt::format("{:g} {}, as {}", comparison.tolerance, comparison.unit, folders[0]));
    }
    queries.push_back(read_errors(folders[i]));
    comparison.runs.push_back({.name = names[i],
                               .folder = folders[i],
                               .evaluation = place::evaluate(queries.back().queries, tolerance),
                               .bootstrap = {}});
  }
  auto bootstraps = place::bootstrap(queries, comparison.tolerance, options);
  for (std::size_t i = 0; i < bootstraps.size(); ++i) comparison.runs[i].bootstrap = std::move(bootstraps[i]);
  return comparison;
}

ordered_json comparison_json(const Comparison& comparison) {
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

}  // namespace retrace
