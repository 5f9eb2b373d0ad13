#include <cstddef>
#include <string>

#include <benchmark/benchmark.h>

#include <place/match/search_method.hpp>
#include <vo/base/parallel.hpp>
#include <vo/base/rng.hpp>

namespace {

/// A walk of `size` queries along a reference as long: three deviations lower at the true places.
place::CostMatrix walked_costs(std::size_t size) {
  place::CostMatrix costs = place::make_cost_matrix(size, size);
  vo::Rng rng(1);
  for (float& cost : costs.values) cost = static_cast<float>(rng.normal());
  for (std::size_t q = 0; q < size; ++q) costs.row(q)[q] -= 3;
  return costs;
}

/// One thread, sequences of 10, the default range of speeds.
void search(benchmark::State& state, const place::SearchMethod& method, std::size_t size) {
  const place::CostMatrix costs = walked_costs(size);
  vo::set_thread_count(1);
  double looked_at = 0;
  for (auto _ : state) looked_at = method.search(costs, {}).looked_at;
  state.counters["looked_at"] = looked_at;
}

}  // namespace

int main(int argc, char** argv) {
  for (const place::SearchMethod& method : place::search_methods()) {
    for (const std::size_t size : {std::size_t{1800}, std::size_t{3576}}) {
      const std::string name = "search/" + std::string(method.name) + "/" + std::to_string(size);
      benchmark::RegisterBenchmark(name.c_str(), search, method, size)
          ->MeasureProcessCPUTime()
          ->Unit(benchmark::kMillisecond);
    }
  }
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
