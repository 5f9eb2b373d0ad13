#include "command.hpp"
#include "evaluation_files.hpp"
#include "json_file.hpp"
#include "report/run_report.hpp"

#include <filesystem>
#include <memory>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <vo/base/error.hpp>

namespace retrace {
namespace {

struct EvaluateOptions {
  CommonOptions common;
  std::string folder;
  TruthOptions truth;
};

void print_table(const place::RunEvaluation& run, const std::filesystem::path& folder) {
  const place::Evaluation& e = run.evaluation;
  fmt::print("  {:<14}{:>10}{:>11}{:>9}{:>9}{:>7}{:>7}{:>7}\n", "", "score", "precision", "recall", "F1",
             "TP", "FP", "FN");
  for (const auto& [name, p] : {std::pair{"max-F1", e.best}, std::pair{"as accepted", run.accepted}}) {
    fmt::print("  {:<14}{:>10.4g}{:>11.3f}{:>9.3f}{:>9.3f}{:>7}{:>7}{:>7}\n", name, p.threshold, p.precision,
               p.recall, p.f1, p.true_positives, p.false_positives, p.false_negatives);
  }
  fmt::print("area under the curve {:.3f}, recall at 100 % precision {:.3f}, recall@1 {:.3f}\n", e.auc_pr,
             e.recall_at_100_precision, e.recall_at_1);
  if (e.errors)
    fmt::print("median error {:.3g} {}, 95 % within {:.3g}\n", e.errors->p50, name_of(run.unit),
               e.errors->p95);
  fmt::print("{} query keyframes, {} with a true place, {} matched; see {}\n", e.queries, e.with_truth,
             e.matched, evaluation_page(folder).string());
}

void evaluate(const EvaluateOptions& options) {
  const TruthOptions& given = options.truth;
  if (!given.pairs.empty() && !given.reference_truth.empty() && given.tolerance.tolerance_frames)
    throw vo::Error("--reference-truth", "has no effect beside --pairs and --tolerance-frames",
                    "--tolerance-m, or --pairs alone");
  const auto [run, metrics] = evaluate_folder(options.folder, options.truth);
  if (options.common.json) {
    fmt::print("{}\n", json_text(metrics, 2));
  } else {
    print_table(run, options.folder);
  }
}

}  // namespace

std::function<void()> declare_evaluate(Arguments& arguments) {
  auto options = std::make_shared<EvaluateOptions>();
  arguments.positional("run", options->folder, "folder written by `retrace localise` or `retrace follow`");
  declare_truth(arguments, options->truth);
  arguments.json(options->common);
  arguments
      .flag("--force", options->common.force,
            "accepted for symmetry: results of an evaluation are always renewed")
      .group("General");
  arguments.footer(
      "Examples:\n"
      "  retrace evaluate run --pairs pairs.csv --tolerance-frames 17\n"
      "  retrace evaluate run --query-truth night.csv --reference-truth day.csv --tolerance-m 4");
  return [options] { evaluate(*options); };
}

}  // namespace retrace
