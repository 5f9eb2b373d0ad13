#include "place/evaluation/bootstrap.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>

#include <vo/base/parallel.hpp>
#include <vo/base/percentile.hpp>
#include <vo/base/rng.hpp>

namespace place {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// A run's queries by segment.
using Segments = std::vector<std::vector<ScoredQuery>>;

void check(std::span<const TimedQueries> runs, const BootstrapOptions& options) {
  if (options.resamples < 1 || !(options.segment_s > 0) ||
      !(options.confidence > 0 && options.confidence < 1))
    throw std::invalid_argument(
        "bootstrap: resamples >= 1, segment_s > 0 and confidence within (0, 1) expected");
  for (const TimedQueries& run : runs) {
    if (run.time_s.size() != run.queries.size())
      throw std::invalid_argument("bootstrap: one time for each query expected");
  }
}

/// Cuts all runs at the same times, into those segments in which any run has a query.
std::vector<Segments> cut(std::span<const TimedQueries> runs, double segment_s) {
  const auto segment_of = [&](double time_s) {
    return static_cast<std::int64_t>(std::floor(time_s / segment_s));
  };
  std::map<std::int64_t, std::size_t> index;
  for (const TimedQueries& run : runs) {
    for (const double time_s : run.time_s) index.emplace(segment_of(time_s), 0);
  }
  std::size_t count = 0;
  for (auto& [segment, i] : index) i = count++;
  std::vector<Segments> all;
  for (const TimedQueries& run : runs) {
    Segments& segments = all.emplace_back(count);
    for (std::size_t i = 0; i < run.queries.size(); ++i)
      segments[index.at(segment_of(run.time_s[i]))].push_back(run.queries[i]);
  }
  return all;
}

/// The interval between percentiles with the same share outside either end, over the values that are numbers.
std::optional<Interval> interval(std::vector<double> values, double confidence) {
  std::erase_if(values, [](double value) { return std::isnan(value); });
  if (values.empty()) return {};
  std::ranges::sort(values);
  const double tail = (1 - confidence) / 2;
  return Interval{vo::percentile(values, tail), vo::percentile(values, 1 - tail)};
}

/// One run's figures in every resample.
struct Figures {
  explicit Figures(std::size_t resamples)
      : max_f1(resamples, kNone), auc_pr(max_f1), recall_at_100_precision(max_f1), recall_at_1(max_f1) {}
  std::vector<double> max_f1, auc_pr, recall_at_100_precision, recall_at_1;

  void set(std::size_t resample, const Evaluation& e) {
    if (e.with_truth == 0) return;
    max_f1[resample] = e.best.f1;
    auc_pr[resample] = e.auc_pr;
    recall_at_100_precision[resample] = e.recall_at_100_precision;
    recall_at_1[resample] = e.recall_at_1;
  }
};

}  // namespace

std::vector<RunBootstrap> bootstrap(std::span<const TimedQueries> runs, double tolerance,
                                    const BootstrapOptions& options) {
  check(runs, options);
  const std::vector<Segments> segments = cut(runs, options.segment_s);
  std::vector<RunBootstrap> results(runs.size());
  const std::size_t count = segments.empty() ? 0 : segments.front().size();
  if (count < 2) return results;

  const auto resamples = static_cast<std::size_t>(options.resamples);
  std::vector<std::vector<std::size_t>> drawn(resamples, std::vector<std::size_t>(count));
  vo::Rng rng(options.seed);
  for (auto& resample : drawn) {
    for (std::size_t& segment : resample) segment = rng.index(count);
  }
  for (std::size_t r = 0; r < runs.size(); ++r) {
    Figures figures(resamples);
    vo::parallel_for(resamples, [&](std::size_t i) {
      std::vector<ScoredQuery> queries;
      for (const std::size_t segment : drawn[i])
        queries.insert(queries.end(), segments[r][segment].begin(), segments[r][segment].end());
      figures.set(i, evaluate(queries, tolerance));
    });
    results[r] = {.max_f1_of = figures.max_f1,
                  .max_f1 = interval(figures.max_f1, options.confidence),
                  .auc_pr = interval(figures.auc_pr, options.confidence),
                  .recall_at_100_precision = interval(figures.recall_at_100_precision, options.confidence),
                  .recall_at_1 = interval(figures.recall_at_1, options.confidence)};
  }
  return results;
}

PairedDifference paired_difference(const RunBootstrap& run, const RunBootstrap& other, double confidence) {
  if (run.max_f1_of.size() != other.max_f1_of.size())
    throw std::invalid_argument("paired_difference: runs of one bootstrap expected");
  std::vector<double> differences;
  PairedDifference result;
  for (std::size_t i = 0; i < run.max_f1_of.size(); ++i) {
    const double difference = run.max_f1_of[i] - other.max_f1_of[i];
    if (std::isnan(difference)) continue;
    differences.push_back(difference);
    result.share_above += difference > 0 ? 1 : difference == 0 ? 0.5 : 0;
  }
  if (!differences.empty()) result.share_above /= static_cast<double>(differences.size());
  result.interval = interval(std::move(differences), confidence);
  return result;
}

}  // namespace place
