#include <cmath>
#include <numeric>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include <place/certainty/place_filter.hpp>
#include <vo/base/rng.hpp>

namespace {

using place::FilterStretch;
using place::PlaceFilter;

constexpr std::size_t kRatios = PlaceFilter::kRatios;

/// The filter as a matrix over all states, the last of them off the route, written from its description.
class BruteForce {
 public:
  BruteForce(std::vector<FilterStretch> stretches, const place::PlaceFilterOptions& options)
      : stretches_(std::move(stretches)), options_(options), places_(stretches_.back().end) {
    for (const auto& s : stretches_) mean_pace_ += s.pace * static_cast<double>(s.end - s.begin);
    mean_pace_ /= static_cast<double>(places_);
    belief_.assign(states(), 0.5 / static_cast<double>(kRatios * places_));
    belief_.back() = 0.5;
  }

  [[nodiscard]] std::size_t states() const { return kRatios * places_ + 1; }

  /// p(to | from) of a move.
  [[nodiscard]] std::vector<std::vector<double>> transition(double moved, double variance) const {
    const double leave = 1 - std::exp(-options_.leave * moved * mean_pace_);
    const double change = (1 - std::exp(-options_.change_speed * moved * mean_pace_)) / 2;
    std::vector<std::vector<double>> p(states(), std::vector<double>(states(), 0.0));
    for (std::size_t k = 0; k < kRatios; ++k) {
      for (const auto& s : stretches_) {
        for (std::size_t r = s.begin; r < s.end; ++r) {
          std::vector<double>& row = p[k * places_ + r];
          for (std::size_t to = 0; to < kRatios; ++to) {
            double mixes = to + 1 == k || k + 1 == to ? change : 0;
            if (to == k) mixes = 1 - change * ((k > 0 ? 1 : 0) + (k + 1 < kRatios ? 1 : 0));
            if (mixes == 0) continue;
            const double step = moved * s.pace * PlaceFilter::ratio(to);
            const double deviation =
                std::sqrt(std::max(0.25, variance * std::pow(s.pace * PlaceFilter::ratio(to), 2)));
            std::vector<double> weight;
            for (int n = 0; n < 40; ++n) {
              const bool near = step == 0 ? n == 0 : std::abs(n - step) <= 3.2 * deviation;
              weight.push_back(near ? std::exp(-(n - step) * (n - step) / (2 * deviation * deviation)) : 0);
            }
            const double sum = std::accumulate(weight.begin(), weight.end(), 0.0);
            for (std::size_t n = 0; n < weight.size(); ++n) {
              const double share = (1 - leave) * mixes * weight[n] / sum;
              if (r + n < s.end) {
                row[to * places_ + r + n] += share;
              } else {
                row.back() += share;
              }
            }
          }
          row.back() += leave;
        }
      }
    }
    for (double& comes_back : p.back()) comes_back = leave / static_cast<double>(kRatios * places_);
    p.back().back() = 1 - leave;
    return p;
  }

  void step(double moved, double variance, const std::vector<float>& log_ratio) {
    const auto p = transition(moved, variance);
    std::vector<double> next(states(), 0.0);
    for (std::size_t from = 0; from < states(); ++from)
      for (std::size_t to = 0; to < states(); ++to) next[to] += belief_[from] * p[from][to];
    double total = 0;
    for (std::size_t i = 0; i < states(); ++i) {
      if (i + 1 < states()) next[i] *= std::exp(static_cast<double>(log_ratio[i % places_]));
      total += next[i];
    }
    for (double& value : next) value /= total;
    belief_ = next;
    history_.push_back({belief_, p, log_ratio});
  }

  /// Smoothed, `back` observations ago.
  [[nodiscard]] std::vector<double> lagged(std::size_t back) const {
    std::vector<double> later(states(), 1.0);
    for (std::size_t i = history_.size() - 1; i > history_.size() - 1 - back; --i) {
      std::vector<double> before(states(), 0.0);
      for (std::size_t from = 0; from < states(); ++from) {
        for (std::size_t to = 0; to < states(); ++to) {
          const double seen =
              to + 1 < states() ? std::exp(static_cast<double>(history_[i].log_ratio[to % places_])) : 1;
          before[from] += history_[i].transition[from][to] * seen * later[to];
        }
      }
      later = before;
    }
    std::vector<double> then = history_[history_.size() - 1 - back].belief;
    double total = 0;
    for (std::size_t i = 0; i < states(); ++i) total += then[i] *= later[i];
    for (double& value : then) value /= total;
    return then;
  }

  [[nodiscard]] const std::vector<double>& belief() const { return belief_; }
  [[nodiscard]] double on(const std::vector<double>& belief, std::size_t begin, std::size_t end) const {
    double sum = 0;
    for (std::size_t k = 0; k < kRatios; ++k)
      for (std::size_t r = begin; r < end; ++r) sum += belief[k * places_ + r];
    return sum;
  }

 private:
  struct Past {
    std::vector<double> belief;
    std::vector<std::vector<double>> transition;
    std::vector<float> log_ratio;
  };
  std::vector<FilterStretch> stretches_;
  place::PlaceFilterOptions options_;
  std::size_t places_;
  double mean_pace_ = 0;
  std::vector<double> belief_;
  std::vector<Past> history_;
};

TEST(PlaceFilter, IsTheBruteForceFilter) {
  const std::vector<FilterStretch> stretches{{0, 9, 1.5}, {9, 14, 0.7}};
  const place::PlaceFilterOptions options{.leave = 0.05, .change_speed = 0.1, .lag = 4};
  PlaceFilter filter(stretches, options);
  BruteForce brute(stretches, options);
  vo::Rng rng(3);
  for (std::size_t step = 0; step < 8; ++step) {
    const double moved = step == 3 ? 0 : rng.uniform(0.1, 1.5), variance = rng.uniform(0, 0.6);
    std::vector<float> log_ratio;
    for (std::size_t r = 0; r < 14; ++r) log_ratio.push_back(static_cast<float>(rng.uniform(-2, 2)));
    filter.move(moved, variance);
    filter.observe(log_ratio);
    brute.step(moved, variance, log_ratio);
    const auto now = filter.estimate(2);
    EXPECT_NEAR(now.off_route, brute.belief().back(), 1e-5);  // the filter counts in floats
    const std::size_t begin = now.place < 9 ? 0 : 9, end = now.place < 9 ? 9 : 14;
    const std::size_t first = std::max(begin, now.place - std::min<std::size_t>(now.place, 2));
    EXPECT_NEAR(now.probability, brute.on(brute.belief(), first, std::min(end, now.place + 3)), 1e-5);
    for (std::size_t back = 0; back <= std::min<std::size_t>(step, 4); ++back) {
      const auto then = filter.lagged(2, back);
      const std::vector<double> smoothed = brute.lagged(back);
      EXPECT_NEAR(then.off_route, smoothed.back(), 1e-5) << step << " " << back;
    }
  }
}

TEST(PlaceFilter, FollowsAWalkerAtTwiceThePaceOfTheReference) {
  PlaceFilter filter({{0, 60, 1}});
  for (std::size_t at = 0; at < 50; at += 2) {
    std::vector<float> log_ratio(60, -1.0F);
    log_ratio[at] = 2;
    if (at > 0) filter.move(1, 0.05);
    filter.observe(log_ratio);
  }
  const auto estimate = filter.estimate(3);
  EXPECT_EQ(estimate.place, 48U);
  EXPECT_GT(estimate.probability, 0.9);
  EXPECT_GT(estimate.ratio, 1.5);
  filter.move(1, 0.05);  // not seen yet, but walked
  EXPECT_NEAR(filter.estimate(3).mean, estimate.mean + estimate.ratio, 1e-6);
  EXPECT_GT(filter.estimate(3).sd, estimate.sd);
}

TEST(PlaceFilter, LeavesTheRouteWhereNothingFitsAndAtItsEnd) {
  PlaceFilter filter({{0, 30, 1}});
  const auto seen_at = [](std::size_t at) {
    std::vector<float> log_ratio(30, -1.0F);
    if (at < 30) log_ratio[at] = 3;
    return log_ratio;
  };
  for (std::size_t at = 0; at < 10; ++at) {
    if (at > 0) filter.move(1, 0.05);
    filter.observe(seen_at(at));
  }
  EXPECT_LT(filter.estimate(3).off_route, 0.01);
  for (int i = 0; i < 15; ++i) {
    filter.move(1, 0.05);
    filter.observe(seen_at(99));
  }
  EXPECT_GT(filter.estimate(3).off_route, 0.95);
  for (std::size_t at = 20; at < 30; ++at) {
    filter.move(1, 0.05);
    filter.observe(seen_at(at));
  }
  EXPECT_EQ(filter.estimate(3).place, 29U);
  EXPECT_LT(filter.estimate(3).off_route, 0.05);
  filter.move(10, 0.05);
  filter.observe(std::vector<float>(30, 0.0F));
  EXPECT_GT(filter.estimate(3).off_route, 0.9);
}

TEST(PlaceFilter, StaysWhereItStands) {
  PlaceFilter filter({{0, 20, 1}});
  std::vector<float> log_ratio(20, -1.0F);
  log_ratio[7] = 6;
  filter.observe(log_ratio);
  const auto before = filter.estimate(2);
  for (int i = 0; i < 5; ++i) filter.observe(std::vector<float>(20, 0.0F));
  EXPECT_EQ(filter.estimate(2).place, 7U);
  EXPECT_NEAR(filter.estimate(2).probability, before.probability, 1e-6);
}

TEST(PlaceFilter, HasOnePlace) {
  PlaceFilter filter({{0, 1, 1}});
  filter.observe(std::vector<float>{2.0F});
  // Half and half before, exp(2) to 1 after.
  EXPECT_NEAR(filter.estimate(3).probability, std::exp(2.0) / (1 + std::exp(2.0)), 1e-6);
  EXPECT_EQ(filter.estimate(3).sd, 0);
}

TEST(PlaceFilter, RefusesWhatIsNoRouteAndNoMove) {
  EXPECT_THROW(PlaceFilter({}), std::invalid_argument);
  EXPECT_THROW(PlaceFilter({{1, 2, 1}}), std::invalid_argument);
  EXPECT_THROW(PlaceFilter({{0, 2, 0}}), std::invalid_argument);
  PlaceFilter filter({{0, 3, 1}});
  EXPECT_THROW(filter.move(-1, 0), std::invalid_argument);
  EXPECT_THROW(filter.observe(std::vector<float>(2)), std::invalid_argument);
  EXPECT_THROW(static_cast<void>(filter.lagged(1, 0)), std::invalid_argument);
}

}  // namespace
