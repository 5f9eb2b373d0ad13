#include "kernels/absolute_difference.hpp"

#include <benchmark/benchmark.h>

#include <place/contrast_enhancement.hpp>
#include <place/cost_matrix.hpp>
#include <place/sequence_search.hpp>
#include <vo/base/parallel.hpp>
#include <vo/base/rng.hpp>

namespace {

constexpr int kWidth = 64;
constexpr int kHeight = 32;

vo::ImageStack random_descriptors(std::size_t count, std::uint64_t seed) {
  vo::ImageStack stack = vo::make_image_stack(kWidth, kHeight, count);
  vo::Rng rng(seed);
  for (auto& pixel : stack.pixels) pixel = static_cast<std::uint8_t>(rng.bits());
  return stack;
}

place::CostMatrix random_costs(std::size_t size) {
  place::CostMatrix costs = place::make_cost_matrix(size, size);
  vo::Rng rng(1);
  for (float& cost : costs.values) cost = static_cast<float>(rng.normal());
  return costs;
}

void report_bytes(benchmark::State& state, std::size_t size) {
  state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(size * size * kWidth * kHeight));
}

/// size x size thumbnails; arguments: size, threads.
void cost_matrix(benchmark::State& state) {
  const auto size = static_cast<std::size_t>(state.range(0));
  vo::set_thread_count(static_cast<int>(state.range(1)));
  const vo::ImageStack query = random_descriptors(size, 1), reference = random_descriptors(size, 2);
  for (auto _ : state) benchmark::DoNotOptimize(place::cost_matrix(query, reference));
  report_bytes(state, size);
}
BENCHMARK(cost_matrix)->Args({1800, 1})->Args({1800, 2})->Unit(benchmark::kMillisecond)->UseRealTime();

/// The same sums by the plain loop, which the others must equal.
void cost_matrix_scalar_twin(benchmark::State& state) {
  const auto size = static_cast<std::size_t>(state.range(0));
  const vo::ImageStack query = random_descriptors(size, 1), reference = random_descriptors(size, 2);
  std::vector<std::uint32_t> sums(size);
  for (auto _ : state) {
    for (std::size_t q = 0; q < size; ++q) {
      place::kernels::absolute_difference_scalar(query[q].data(), reference.pixels.data(), size,
                                                 kWidth * kHeight, sums.data());
      benchmark::DoNotOptimize(sums.data());
    }
  }
  report_bytes(state, size);
}
BENCHMARK(cost_matrix_scalar_twin)->Arg(1800)->Unit(benchmark::kMillisecond)->UseRealTime();

/// Arguments: size, sequence length, threads; 21 slopes over +-0.5 rad.
void sequence_search(benchmark::State& state) {
  const place::CostMatrix costs = random_costs(static_cast<std::size_t>(state.range(0)));
  vo::set_thread_count(static_cast<int>(state.range(2)));
  const place::SequenceSearchOptions options{.length = static_cast<int>(state.range(1)),
                                             .search_range_rad = 0.5};
  for (auto _ : state) benchmark::DoNotOptimize(place::search_sequences(costs, options));
  state.counters["lines"] = static_cast<double>(place::search_lines(options).size());
}
BENCHMARK(sequence_search)
    ->Args({1800, 10, 2})
    ->Args({1800, 20, 1})
    ->Args({1800, 20, 2})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

void enhance(benchmark::State& state, place::Enhancement method) {
  vo::set_thread_count(2);
  const place::CostMatrix costs = random_costs(1800);
  for (auto _ : state) {
    place::CostMatrix enhanced = costs;
    place::enhance_contrast(enhanced, {.method = method});
    benchmark::DoNotOptimize(enhanced.values.data());
  }
}
BENCHMARK_CAPTURE(enhance, local, place::Enhancement::kLocal)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_CAPTURE(enhance, standardise, place::Enhancement::kStandardise)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

}  // namespace
