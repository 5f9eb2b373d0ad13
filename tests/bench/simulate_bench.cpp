// How fast walks are drawn: items_per_second is frames of 640x360 a second.
#include <benchmark/benchmark.h>

#include <simulate/simulator.hpp>
#include <vo/base/parallel.hpp>

namespace {

using simulate::Condition;
using simulate::Scene;

simulate::Options walk_of(benchmark::State& state) {
  simulate::Options options;
  options.scene = static_cast<Scene>(state.range(0));
  options.condition = static_cast<Condition>(state.range(1));
  return options;
}

void draw_frames(benchmark::State& state) {
  const simulate::WalkSimulator walk(walk_of(state));
  constexpr int kBatch = 16;
  int begin = 0;
  for (auto _ : state) {
    // Frames from all along the walk, as many at a time as the recorder draws.
    vo::parallel_for(kBatch, [&](std::size_t i) {
      benchmark::DoNotOptimize(walk.render((begin + 37 * static_cast<int>(i)) % walk.frame_count()));
    });
    begin = (begin + 37 * kBatch) % walk.frame_count();
  }
  state.SetItemsProcessed(state.iterations() * kBatch);
}

void build_world(benchmark::State& state) {
  const simulate::Options options = walk_of(state);
  for (auto _ : state) benchmark::DoNotOptimize(simulate::WalkSimulator(options).frame_count());
}

BENCHMARK(draw_frames)
    ->ArgNames({"scene", "condition"})
    ->ArgsProduct({{0, 1}, {0, 1, 2}})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK(build_world)
    ->ArgNames({"scene", "condition"})
    ->ArgsProduct({{0, 1}, {0}})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

}  // namespace
