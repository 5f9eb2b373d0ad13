// With --costs FILE.npy, the time of matches and their probabilities on those costs, which
// python_overhead.py compares with the same call from Python.
#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>

#include <benchmark/benchmark.h>

#include <place/certainty/sure_search.hpp>
#include <place/describe/npy.hpp>
#include <place/match/search_method.hpp>
#include <place/resolve.hpp>
#include <place/stage_options.hpp>
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

place::CostMatrix read_costs(const std::string& file) {
  const place::FloatRows rows = place::read_npy(file);
  place::CostMatrix costs = place::make_cost_matrix(rows.size(), rows.width);
  for (std::size_t q = 0; q < rows.size(); ++q) std::ranges::copy(rows[q], costs.row(q).begin());
  return costs;
}

/// One thread, sequences of 10, as the settings have it.
void search_surely(benchmark::State& state, const place::SearchMethod& method, const std::string& file) {
  const place::CostMatrix costs = read_costs(file);
  place::Settings settings;
  settings.search = std::string(method.name);
  settings.sequence_length = 10;
  const place::SearchOptions options{.sequence =
                                         place::stage_options(place::resolve(settings, {})).matching.search};
  vo::set_thread_count(1);
  for (auto _ : state) benchmark::DoNotOptimize(place::search_surely(costs, method, options).matches.data());
}

}  // namespace

int main(int argc, char** argv) {
  std::string costs;
  if (argc > 2 && std::string_view(argv[1]) == "--costs") {
    costs = argv[2];
    std::rotate(argv + 1, argv + 3, argv + argc);
    argc -= 2;
  }
  for (const place::SearchMethod& method : place::search_methods()) {
    if (!costs.empty()) {
      benchmark::RegisterBenchmark(("surely/" + std::string(method.name)).c_str(), search_surely, method,
                                   costs)
          ->MeasureProcessCPUTime()
          ->Unit(benchmark::kMillisecond);
      continue;
    }
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
