#include "support/drifting_walk.hpp"

#include <benchmark/benchmark.h>

#include <place/trajectory/drift_correction.hpp>
#include <place/trajectory/fixed_lag.hpp>

namespace {

using namespace test_support;

/// A walk with a node every half metre and a match at every other, a tenth of them wrong.
struct Walk {
  vo::Trajectory odometry;
  std::vector<place::PoseFix> fixes;

  explicit Walk(std::size_t nodes) {
    const vo::Trajectory truth = walk_round_corners(nodes, 1);
    odometry = drifted(
        truth, {.step_scale = 1.08, .turn_scale = 1.05, .step_noise_m = 0.08, .turn_noise_rad = 0.03});
    fixes = fixes_of(truth, 2, 0.4, 0.2);
    replace_at_random(fixes, truth, 0.1, 1);
  }
};

/// Argument: nodes; 20,000 are ten kilometres.
void batch(benchmark::State& state) {
  const Walk walk(static_cast<std::size_t>(state.range(0)));
  for (auto _ : state) benchmark::DoNotOptimize(place::correct_drift(walk.odometry, walk.fixes));
}
BENCHMARK(batch)
    ->Arg(1000)
    ->Arg(5000)
    ->Arg(10000)
    ->Arg(20000)
    ->Arg(40000)
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime();

/// One node of the fixed-lag form, every other with a match. Argument: lag.
void fixed_lag(benchmark::State& state) {
  const Walk walk(400);
  for (auto _ : state) {
    place::FixedLagCorrector corrector({.lag = static_cast<std::size_t>(state.range(0))});
    for (std::size_t i = 0; i < walk.odometry.size(); ++i)
      corrector.push(walk.odometry[i], i % 2 == 0 ? std::optional(walk.fixes[i / 2]) : std::nullopt);
  }
  state.SetItemsProcessed(state.iterations() * 400);
}
BENCHMARK(fixed_lag)->Arg(30)->Arg(60)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime();

}  // namespace
