#include "benchmark_files.hpp"

#include "json_file.hpp"
#include "methods_table.hpp"
#include "report/compare_report.hpp"
#include "report/page.hpp"
#include "report/sweep_report.hpp"

#include <algorithm>
#include <filesystem>
#include <optional>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <place/evaluation/method_ranks.hpp>
#include <vo/io/atomic_file.hpp>

namespace retrace {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;
using place::ComparedMethod;
using place::SweepCell;
using place::UncertainCell;

/// All methods, in the order in which the pairs have them first.
std::vector<SweepCell> methods_of(const std::vector<SweptPair>& pairs) {
  std::vector<SweepCell> methods;
  for (const SweptPair& pair : pairs) {
    for (const ComparedMethod& method : pair.methods)
      if (std::ranges::find(methods, method.values) == methods.end()) methods.push_back(method.values);
  }
  return methods;
}

/// A method on a pair; null where it could not be run.
const ComparedMethod* on_pair(const SweptPair& pair, const SweepCell& values) {
  const auto method = std::ranges::find(pair.methods, values, &ComparedMethod::values);
  return method == pair.methods.end() ? nullptr : &*method;
}

using WhichCell = UncertainCell ComparedMethod::*;

/// The mean rank of each method over the pairs.
std::vector<double> ranks_of(const std::vector<SweptPair>& pairs, const std::vector<SweepCell>& methods,
                             WhichCell which) {
  std::vector<std::vector<std::optional<double>>> figures;
  for (const SweptPair& pair : pairs) {
    std::vector<std::optional<double>>& of_pair = figures.emplace_back();
    for (const SweepCell& values : methods) {
      const ComparedMethod* const method = on_pair(pair, values);
      of_pair.push_back(method != nullptr ? std::optional((method->*which).result.max_f1) : std::nullopt);
    }
  }
  return place::mean_ranks(figures);
}

/// A row for each method, a column for each pair, the mean rank last.
MethodsTable methods_by_pairs(const SweepOptions& options, const std::vector<SweptPair>& pairs,
                              WhichCell which) {
  const std::vector<SweepCell> methods = methods_of(pairs);
  const std::vector<double> ranks = ranks_of(pairs, methods, which);
  MethodsTable table{.header = options.compare, .rows = {}, .note = {}};
  for (const SweptPair& pair : pairs) table.header.push_back(pair.name);
  table.header.emplace_back("mean rank");
  for (std::size_t m = 0; m < methods.size(); ++m) {
    std::vector<std::string>& row = table.rows.emplace_back(methods[m]);
    for (const SweptPair& pair : pairs) {
      const ComparedMethod* const method = on_pair(pair, methods[m]);
      row.push_back(
          method == nullptr ? "–" : with_interval((method->*which).result.max_f1, (method->*which).interval));
    }
    row.push_back(fmt::format("{:.2f}", ranks[m]));
  }
  return table;
}

ordered_json benchmark_json(const SweepOptions& options, const std::vector<place::SweepAxis>& axes,
                            const std::vector<SweptPair>& pairs) {
  ordered_json json{{"pairs", ordered_json::array()}, {"ranks", ordered_json::array()}};
  for (const SweptPair& pair : pairs)
    json["pairs"].push_back(
        {{"name", pair.name}, {"methods", methods_json(axes, options.compare, pair.methods)}});
  const std::vector<SweepCell> methods = methods_of(pairs);
  const std::vector<double> best = ranks_of(pairs, methods, &ComparedMethod::best);
  const std::vector<double> standard = ranks_of(pairs, methods, &ComparedMethod::standard);
  for (std::size_t m = 0; m < methods.size(); ++m) {
    ordered_json& row = json["ranks"].emplace_back();
    for (std::size_t i = 0; i < options.compare.size(); ++i)
      row["method"][options.compare[i]] = methods[m][i];
    row["mean_rank_best"] = best[m];
    row["mean_rank_default"] = standard[m];
  }
  return json;
}

std::string bounds(const std::optional<place::Interval>& interval) {
  return interval ? fmt::format("{:.9g},{:.9g}", interval->low, interval->high) : ",";
}

std::string benchmark_csv(const SweepOptions& options, const std::vector<place::SweepAxis>& axes,
                          const std::vector<SweptPair>& pairs) {
  std::string csv = fmt::format(
      "pair,{},with_truth,max_f1,max_f1_low,max_f1_high,default_max_f1,"
      "default_max_f1_low,default_max_f1_high,difference,difference_low,"
      "difference_high,density,query_keyframes,reference_keyframes",
      fmt::join(options.compare, ","));
  std::vector<std::size_t> others;
  for (std::size_t i = 0; i < axes.size(); ++i) {
    if (std::ranges::find(options.compare, axes[i].setting) != options.compare.end()) continue;
    others.push_back(i);
    csv += fmt::format(",best_{}", axes[i].setting);
  }
  csv += "\n";
  for (const SweptPair& pair : pairs) {
    for (const ComparedMethod& method : pair.methods) {
      const place::CellResult& best = method.best.result;
      csv += fmt::format(
          "{},{},{},{:.9g},{},{:.9g},{},{:.9g},{},{},{},{}", pair.name, fmt::join(method.values, ","),
          method.with_truth, best.max_f1, bounds(method.best.interval), method.standard.result.max_f1,
          bounds(method.standard.interval), best.max_f1 - pair.methods[method.baseline].best.result.max_f1,
          bounds(method.difference.interval), best.density, best.query_keyframes, best.reference_keyframes);
      for (const std::size_t i : others) csv += fmt::format(",{}", method.best.cell[i]);
      csv += "\n";
    }
  }
  return csv;
}

std::string benchmark_report(const SweepOptions& options, const std::vector<place::SweepAxis>& axes,
                             const std::vector<SweptPair>& pairs) {
  Page page("Which methods find walks",
            fmt::format("{} pairs of walks, {} cells each", pairs.size(), place::cells_by_work(axes).size()));
  page.heading("Each method at its best");
  const MethodsTable best = methods_by_pairs(options, pairs, &ComparedMethod::best);
  page.table(best.header, best.rows);
  page.paragraph(
      "Max-F1, in brackets 95 of 100 resamples of the walk's stretches. The best settings were chosen on the "
      "walk itself, so on another these figures are somewhat lower. The rank is 1 for the best of a pair; "
      "equal ones share theirs, and a method that cannot be run on a pair ranks last there.");
  page.heading("Each method at its defaults");
  const MethodsTable standard = methods_by_pairs(options, pairs, &ComparedMethod::standard);
  page.table(standard.header, standard.rows);
  for (const SweptPair& pair : pairs) {
    page.heading(pair.name);
    const MethodsTable table = methods_table(axes, options.compare, pair.methods);
    page.table(table.header, table.rows);
    if (!table.note.empty()) page.paragraph(table.note);
    page.heat_tables(heat_tables(axes, pair.results));
  }
  page.heading("Where the rest is");
  page.paragraph("Each pair's folder, by its name, has a page of its own with curves and all cells.");
  return page.html();
}

}  // namespace

void write_benchmark(const SweepOptions& options, const std::vector<place::SweepAxis>& axes,
                     const std::vector<SweptPair>& pairs) {
  const fs::path folder = options.output;
  vo::write_file(folder / "benchmark.csv", benchmark_csv(options, axes, pairs));
  vo::write_file(folder / "benchmark.json", json_text(benchmark_json(options, axes, pairs), 2) + "\n");
  vo::write_file(folder / "report.html", benchmark_report(options, axes, pairs));
}

void print_benchmark(const SweepOptions& options, const std::vector<place::SweepAxis>& axes,
                     const std::vector<SweptPair>& pairs) {
  if (options.common.json) {
    fmt::print("{}\n", json_text(benchmark_json(options, axes, pairs), 2));
    return;
  }
  fmt::print("{}", methods_text(methods_by_pairs(options, pairs, &ComparedMethod::best)));
  std::vector<std::string> few;
  for (const SweptPair& pair : pairs) {
    const MethodsTable table = methods_table(axes, options.compare, pair.methods);
    if (!table.note.empty()) few.push_back(fmt::format("{}: {}", pair.name, table.note));
  }
  for (const std::string& note : few) fmt::print("{}\n", note);
  fmt::print("max-F1 of {} pairs at the best settings of each; see {}\n", pairs.size(),
             (fs::path(options.output) / "report.html").string());
}

}  // namespace retrace
