#include "demo_results.hpp"

#include <string>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace retrace {
namespace {

using nlohmann::ordered_json;

ordered_json as_json(const DemoRun& run) {
  const place::Evaluation& e = run.evaluated.evaluation;
  ordered_json json{{"reference_keyframes", run.references},
                    {"query_keyframes", e.queries},
                    {"max_f1", e.best.f1},
                    {"precision", e.best.precision},
                    {"recall", e.best.recall},
                    {"median_error_m", nullptr},
                    {"p95_error_m", nullptr},
                    {"report", (run.folder / "report.html").string()}};
  if (run.every > 0) json["every"] = run.every;
  if (e.errors) json["median_error_m"] = e.errors->p50;
  if (e.errors) json["p95_error_m"] = e.errors->p95;
  return json;
}

void print_row(const std::string& name, const DemoRun& run) {
  const place::Evaluation& e = run.evaluated.evaluation;
  fmt::print("  {:<28}{:>4} x {:<4}{:>8.3f}{:>11.3f}{:>9.3f}", name, e.queries, run.references, e.best.f1,
             e.best.precision, e.best.recall);
  if (e.errors) fmt::print("{:>12.2f} m{:>12.2f} m", e.errors->p50, e.errors->p95);
  fmt::print("\n");
}

}  // namespace

ordered_json demo_json(const DemoResults& results) {
  return {{"seed", results.seed},
          {"length_m", results.length_m},
          {"tolerance_m", kDemoTolerance_m},
          {"vanilla", as_json(results.vanilla)},
          {"normalised", as_json(results.normalised)},
          {"overview", results.overview.string()},
          {"seconds", results.seconds}};
}

void print_demo(const DemoResults& results) {
  fmt::print("{:g} m of a made-up street, by day (slow, then fast) and by night (fast, then slow):\n\n",
             results.length_m);
  fmt::print("  {:<28}{:>11}{:>8}{:>11}{:>9}{:>14}{:>14}\n", "", "keyframes", "max-F1", "precision", "recall",
             "median error", "95 % within");
  print_row(fmt::format("vanilla, every {}th frame", results.vanilla.every), results.vanilla);
  print_row("speed-normalised by steps", results.normalised);
  fmt::print(
      "\nBoth compare {}s, as the papers do. Right is within {:g} m of the true place. Drawn and found in "
      "{:.0f} s.\n",
      kDemoDescriptor, kDemoTolerance_m, results.seconds);
  fmt::print("Look at {} and {}.\n", results.overview.string(),
             (results.normalised.folder / "report.html").string());
}

}  // namespace retrace
