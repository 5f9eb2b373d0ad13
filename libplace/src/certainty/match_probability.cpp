#include "place/certainty/match_probability.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace place {
namespace {

double logistic(double x) {
  return 1 / (1 + std::exp(-std::clamp(x, -30.0, 30.0)));
}

/// The quantile of sorted values at a share, linearly interpolated.
double quantile_of(std::span<const double> sorted, double share) {
  const double at = share * static_cast<double>(sorted.size() - 1);
  const auto low = static_cast<std::size_t>(at);
  const std::size_t high = std::min(sorted.size() - 1, low + 1);
  return sorted[low] + (at - static_cast<double>(low)) * (sorted[high] - sorted[low]);
}

/// log(odds) = offset + slope * x.
struct Line {
  double offset = 0, slope = 0;
};

/// Scores in deviations from the decoys' mean, each with its weight of being right and of being wrong.
struct Weighted {
  double x, right, wrong;
};

/// Logistic regression by Newton's method, starting from `line`. A normal prior of deviation 10 draws the
/// slope to 0: without it, two groups that do not overlap would have no finite slope.
Line regress(std::span<const Weighted> scores, Line line) {
  constexpr double kPrior = 0.01, kLongestStep = 3, kSmallest = 1e-8;
  constexpr int kRounds = 30;
  for (int round = 0; round < kRounds; ++round) {
    double g0 = 0, g1 = -kPrior * line.slope, h00 = 1e-6, h01 = 0, h11 = kPrior;
    for (const auto& [x, right, wrong] : scores) {
      const double p = logistic(line.offset + line.slope * x), weight = right + wrong;
      const double residual = right - weight * p, curvature = weight * p * (1 - p);
      g0 += residual;
      g1 += residual * x;
      h00 += curvature;
      h01 += curvature * x;
      h11 += curvature * x * x;
    }
    const double determinant = h00 * h11 - h01 * h01;
    double d0 = (h11 * g0 - h01 * g1) / determinant, d1 = (h00 * g1 - h01 * g0) / determinant;
    const double longest = std::max(std::abs(d0), std::abs(d1));
    if (longest > kLongestStep) {
      d0 *= kLongestStep / longest;
      d1 *= kLongestStep / longest;
    }
    line.offset += d0;
    line.slope += d1;
    if (longest < kSmallest) break;
  }
  line.slope = std::max(0.0, line.slope);  // a higher score is never less sure
  return line;
}

}  // namespace

MatchProbabilities match_probabilities(std::span<const double> scores, std::span<const double> decoys,
                                       const MatchProbabilityOptions& options) {
  const auto is_finite = [](double score) { return std::isfinite(score); };
  if (!std::ranges::all_of(scores, is_finite) || !std::ranges::all_of(decoys, is_finite))
    throw std::invalid_argument("match_probabilities: finite scores expected");
  if (!(options.decoy_quantile > 0 && options.decoy_quantile <= 1))
    throw std::invalid_argument("match_probabilities: 0 < decoy_quantile <= 1 expected");
  MatchProbabilities result;
  if (scores.size() < kFewestScores) {
    result.status = ProbabilityStatus::kFewMatches;
    return result;
  }
  if (decoys.size() < kFewestScores) {
    result.status = ProbabilityStatus::kFewDecoys;
    return result;
  }

  std::vector<double> sorted(decoys.begin(), decoys.end());
  std::ranges::sort(sorted);
  const auto count = static_cast<double>(scores.size());
  const double quantile = quantile_of(sorted, options.decoy_quantile);
  const auto below =
      static_cast<double>(std::ranges::count_if(scores, [&](double s) { return s < quantile; }));
  const double wrong = (below + options.decoy_quantile) / (options.decoy_quantile * (count + 1));
  // A share is known to half a match at best.
  result.wrong_share = std::clamp(wrong, 0.5 / count, 1 - 0.5 / count);

  double mean = 0, variance = 0;
  for (const double s : sorted) mean += s / static_cast<double>(sorted.size());
  for (const double s : sorted) variance += (s - mean) * (s - mean) / static_cast<double>(sorted.size());
  // Decoys that are all equal show where wrong matches lie, but not their spread.
  const double deviation = sorted.front() < sorted.back() ? std::sqrt(variance) : 1;
  const double high = quantile_of(sorted, 0.9);
  constexpr double kFirstGuess = 0.95;
  std::vector<Weighted> all;
  for (const double s : scores) {
    const double right = s > high ? kFirstGuess : 1 - kFirstGuess;
    all.push_back({(s - mean) / deviation, right, 1 - right});
  }
  for (const double s : sorted) all.push_back({(s - mean) / deviation, 0, 1});

  constexpr int kRounds = 200;
  constexpr double kSmallest = 1e-6;
  const double prior_odds = std::log((1 - result.wrong_share) / result.wrong_share);
  Line line;
  for (int round = 0; round < kRounds; ++round) {
    line = regress(all, line);
    double right = 0, not_right = 0;
    for (const Weighted& score : all) {
      right += score.right;
      not_right += score.wrong;
    }
    double most_changed = 0;
    for (std::size_t i = 0; i < scores.size(); ++i) {
      // log(f1 / f0), from odds that include the groups' sizes.
      const double tilt = line.offset + line.slope * all[i].x - std::log(right / not_right);
      const double probability = logistic(tilt + prior_odds);
      most_changed = std::max(most_changed, std::abs(probability - all[i].right));
      all[i].right = probability;
      all[i].wrong = 1 - probability;
    }
    if (most_changed < kSmallest) break;
  }
  for (std::size_t i = 0; i < scores.size(); ++i) result.probability.push_back(all[i].right);
  return result;
}

}  // namespace place
