#include "place/evaluation/evaluation.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <vo/base/percentile.hpp>

namespace place {
namespace {

bool is_right(const ScoredQuery& query, double tolerance) {
  return query.error && *query.error <= tolerance;
}

struct Counts {
  std::size_t accepted = 0;
  std::size_t right = 0;

  void accept(const ScoredQuery& query, double tolerance) {
    ++accepted;
    right += is_right(query, tolerance) ? 1 : 0;
  }

  [[nodiscard]] OperatingPoint at(double threshold, std::size_t with_truth) const {
    OperatingPoint point{.threshold = threshold,
                         .true_positives = right,
                         .false_positives = accepted - right,
                         .false_negatives = with_truth - right};
    const auto tp = static_cast<double>(right);
    point.precision = accepted > 0 ? tp / static_cast<double>(accepted) : 1;
    point.recall = with_truth > 0 ? tp / static_cast<double>(with_truth) : 0;
    // 2PR / (P + R) with both written out; 0 rather than 0 / 0.
    point.f1 = accepted + with_truth > 0 ? 2 * tp / static_cast<double>(accepted + with_truth) : 0;
    return point;
  }
};

std::size_t count_with_truth(std::span<const ScoredQuery> queries) {
  return static_cast<std::size_t>(std::ranges::count_if(queries, &ScoredQuery::has_truth));
}

void check(std::span<const ScoredQuery> queries, double tolerance) {
  if (!(tolerance >= 0)) throw std::invalid_argument("evaluate: tolerance must be >= 0");
  if (std::ranges::any_of(queries, [](const ScoredQuery& q) { return q.score && std::isnan(*q.score); })) {
    throw std::invalid_argument("evaluate: a score is not a number");
  }
}

}  // namespace

OperatingPoint operating_point(std::span<const ScoredQuery> queries, double tolerance, double threshold) {
  check(queries, tolerance);
  Counts counts;
  for (const ScoredQuery& query : queries) {
    if (query.score && *query.score >= threshold) counts.accept(query, tolerance);
  }
  return counts.at(threshold, count_with_truth(queries));
}

Evaluation evaluate(std::span<const ScoredQuery> queries, double tolerance) {
  check(queries, tolerance);
  Evaluation result;
  result.queries = queries.size();
  result.with_truth = count_with_truth(queries);

  std::vector<ScoredQuery> ranked;
  std::vector<double> errors;
  std::size_t right = 0;
  for (const ScoredQuery& query : queries) {
    if (!query.score) continue;
    ranked.push_back(query);
    result.matched_without_truth += query.has_truth ? 0 : 1;
    right += is_right(query, tolerance) ? 1 : 0;
    if (query.error) errors.push_back(*query.error);
  }
  result.matched = ranked.size();
  if (result.with_truth > 0)
    result.recall_at_1 = static_cast<double>(right) / static_cast<double>(result.with_truth);

  std::ranges::sort(ranked, std::ranges::greater{}, [](const ScoredQuery& query) { return *query.score; });
  Counts counts;
  result.best = counts.at(0, result.with_truth);  // where nothing is accepted
  double recall_before = 0;
  for (std::size_t i = 0; i < ranked.size(); ++i) {
    counts.accept(ranked[i], tolerance);
    if (i + 1 < ranked.size() && *ranked[i + 1].score == *ranked[i].score)
      continue;  // equal scores form one threshold
    const OperatingPoint point = counts.at(*ranked[i].score, result.with_truth);
    if (result.curve.empty() || point.f1 > result.best.f1) result.best = point;
    if (point.false_positives == 0) result.recall_at_100_precision = point.recall;
    result.auc_pr += point.precision * (point.recall - recall_before);
    recall_before = point.recall;
    result.curve.push_back(point);
  }

  if (!errors.empty()) {
    std::ranges::sort(errors);
    using vo::percentile;
    result.errors = ErrorPercentiles{.p50 = percentile(errors, 0.5),
                                     .p75 = percentile(errors, 0.75),
                                     .p90 = percentile(errors, 0.9),
                                     .p95 = percentile(errors, 0.95),
                                     .p99 = percentile(errors, 0.99),
                                     .max = errors.back()};
  }
  return result;
}

}  // namespace place
