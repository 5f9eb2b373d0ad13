#include "dot_limit.hpp"
#include "kernels/absolute_difference.hpp"
#include "sad_limit.hpp"
#include "support/random_columns.hpp"

#include <algorithm>
#include <cstring>
#include <faiss/utils/extra_distances.h>
#include <filesystem>
#include <vector>

#include <benchmark/benchmark.h>
#include <opencv2/core.hpp>

#include <place/match/contrast_enhancement.hpp>
#include <place/match/cost_matrix.hpp>
#include <place/match/sequence_search.hpp>
#include <place/match/shifted_cosine.hpp>
#include <place/match/streamed_search.hpp>
#include <place/route/route_database.hpp>
#include <vo/base/parallel.hpp>
#include <vo/base/rng.hpp>

namespace {

constexpr int kWidth = 64;
constexpr int kHeight = 32;
constexpr std::size_t kPixels = kWidth * kHeight;

vo::ImageStack random_descriptors(std::size_t count, std::uint64_t seed) {
  vo::ImageStack stack = vo::make_image_stack(kWidth, kHeight, count);
  vo::Rng rng(seed);
  for (std::size_t i = 0; i + sizeof(std::uint64_t) <= stack.pixels.size(); i += sizeof(std::uint64_t)) {
    const std::uint64_t eight = rng.bits();
    std::memcpy(&stack.pixels[i], &eight, sizeof eight);
  }
  return stack;
}

/// The default descriptor's form.
place::ColumnStack blocks(std::size_t count, std::uint64_t seed) {
  constexpr int kColumns = 8, kChannels = 128, kMost = 63;
  return test_support::random_columns(kColumns, kChannels, count, kMost, seed);
}

/// A benchmark's two walks: its first two arguments are how many keyframes they have.
struct Walks {
  explicit Walks(const benchmark::State& state)
      : query(random_descriptors(static_cast<std::size_t>(state.range(0)), 1)),
        reference(random_descriptors(static_cast<std::size_t>(state.range(1)), 2)) {}

  /// Bytes of differences, which every cost matrix is measured in.
  void report(benchmark::State& state) const {
    state.SetBytesProcessed(state.iterations() *
                            static_cast<std::int64_t>(query.size() * reference.size() * kPixels));
  }

  vo::ImageStack query, reference;
};

// ---- The cost matrix, its limit and its peers. One thread unless it says otherwise. ----

BENCHMARK(bench::sad_limit)->Name("sad_limit")->Unit(benchmark::kMillisecond);
BENCHMARK(bench::sad_limit)->Name("sad_limit")->Threads(2)->Unit(benchmark::kMillisecond);

/// Arguments: queries, references, threads. Into memory that is there, as a search streams.
void cost_matrix(benchmark::State& state) {
  vo::set_thread_count(static_cast<int>(state.range(2)));
  const Walks walks(state);
  const place::ThumbnailCosts source(walks.query, walks.reference);
  place::CostMatrix matrix = place::make_cost_matrix(walks.query.size(), walks.reference.size());
  for (auto _ : state) {
    source.compute(place::block_of(matrix));
    benchmark::DoNotOptimize(matrix.values.data());
  }
  walks.report(state);
}
BENCHMARK(cost_matrix)
    ->Args({3576, 3576, 1})
    ->Args({3576, 3576, 2})
    ->Args({100, 100000, 1})
    ->Args({100, 100000, 2})
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime();

BENCHMARK(bench::dot_limit)->Name("dot_limit")->Unit(benchmark::kMillisecond);

/// The same of the default descriptor, five shifts.
void column_matrix(benchmark::State& state) {
  vo::set_thread_count(static_cast<int>(state.range(2)));
  const place::ColumnStack query = blocks(static_cast<std::size_t>(state.range(0)), 1);
  const place::ColumnStack reference = blocks(static_cast<std::size_t>(state.range(1)), 2);
  const place::ShiftedCosine source(query, reference);
  place::CostMatrix matrix = place::make_cost_matrix(query.size(), reference.size());
  for (auto _ : state) {
    source.compute(place::block_of(matrix));
    benchmark::DoNotOptimize(matrix.values.data());
  }
}
BENCHMARK(column_matrix)
    ->Args({3576, 3576, 1})
    ->Args({3576, 3576, 2})
    ->Args({100, 100000, 1})
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime();

/// Arguments: queries, references, pixels to either side.
void cost_matrix_shifted(benchmark::State& state) {
  vo::set_thread_count(1);
  const Walks walks(state);
  const place::CostOptions options{.max_shift_px = static_cast<int>(state.range(2))};
  for (auto _ : state) benchmark::DoNotOptimize(place::cost_matrix(walks.query, walks.reference, options));
  walks.report(state);
}
BENCHMARK(cost_matrix_shifted)
    ->Args({1000, 1000, 0})
    ->Args({1000, 1000, 1})
    ->Args({1000, 1000, 2})
    ->Args({1000, 1000, 4})
    ->Unit(benchmark::kMillisecond);

/// The plain loop, which the others must equal.
void cost_matrix_scalar(benchmark::State& state) {
  const Walks walks(state);
  std::vector<float> sums(walks.query.size() * walks.reference.size());
  for (auto _ : state) {
    place::kernels::absolute_difference_scalar({walks.query.pixels.data(), walks.query.size()},
                                               {walks.reference.pixels.data(), walks.reference.size()},
                                               {kPixels, kPixels}, {1, sums.data(), walks.reference.size()});
    benchmark::DoNotOptimize(sums.data());
  }
  walks.report(state);
}
BENCHMARK(cost_matrix_scalar)->Args({500, 500})->Unit(benchmark::kMillisecond);

void cost_matrix_opencv(benchmark::State& state) {
  cv::setNumThreads(1);
  Walks walks(state);
  const auto as_mat = [](vo::ImageStack& stack) {
    return cv::Mat(static_cast<int>(stack.size()), static_cast<int>(kPixels), CV_8U, stack.pixels.data());
  };
  const cv::Mat query = as_mat(walks.query), reference = as_mat(walks.reference);
  cv::Mat sums;
  for (auto _ : state) {
    cv::batchDistance(query, reference, sums, CV_32S, cv::noArray(), cv::NORM_L1);
    benchmark::DoNotOptimize(sums.data);
  }
  walks.report(state);
}
BENCHMARK(cost_matrix_opencv)->Args({500, 500})->Unit(benchmark::kMillisecond);

/// Flat L1 on floats: FAISS has none on bytes. It spreads over OpenMP's threads; their processor time counts.
void cost_matrix_faiss(benchmark::State& state) {
  const Walks walks(state);
  const auto as_floats = [](const vo::ImageStack& stack) {
    return std::vector<float>(stack.pixels.begin(), stack.pixels.end());
  };
  const std::vector<float> query = as_floats(walks.query), reference = as_floats(walks.reference);
  std::vector<float> sums(walks.query.size() * walks.reference.size());
  for (auto _ : state) {
    faiss::pairwise_extra_distances(kPixels, static_cast<std::int64_t>(walks.query.size()), query.data(),
                                    static_cast<std::int64_t>(walks.reference.size()), reference.data(),
                                    faiss::METRIC_L1, 0, sums.data());
    benchmark::DoNotOptimize(sums.data());
  }
  walks.report(state);
}
BENCHMARK(cost_matrix_faiss)->Args({500, 500})->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime();

// ---- Enhancement and search ----

place::CostMatrix random_costs(std::size_t size) {
  place::CostMatrix costs = place::make_cost_matrix(size, size);
  vo::Rng rng(1);
  for (float& cost : costs.values) cost = static_cast<float>(rng.normal());
  return costs;
}

/// Arguments: size, sequence length, threads; the default range.
void sequence_search(benchmark::State& state) {
  const place::CostMatrix costs = random_costs(static_cast<std::size_t>(state.range(0)));
  vo::set_thread_count(static_cast<int>(state.range(2)));
  const place::SequenceSearchOptions options{.length = static_cast<int>(state.range(1))};
  for (auto _ : state) benchmark::DoNotOptimize(place::search_sequences(costs, options));
  state.counters["lines"] = static_cast<double>(place::search_lines(options).size());
}
BENCHMARK(sequence_search)
    ->ArgsProduct({{1800, 3576}, {10, 20, 50}, {1}})
    ->MeasureProcessCPUTime()
    ->Unit(benchmark::kMillisecond);

/// The peer: the straightforward search, a line's terms added up for all references at a time, which
/// compilers vectorise. Without the ends, the scores and the matches, which take it more. Arguments: size,
/// sequence length.
void sequence_search_plain(benchmark::State& state) {
  const place::CostMatrix costs = random_costs(static_cast<std::size_t>(state.range(0)));
  const int length = static_cast<int>(state.range(1)), half = length / 2;
  const auto lines = place::search_lines({.length = length});
  const auto size = static_cast<int>(costs.references);
  std::vector<float> sums(costs.references), best(costs.references);
  for (auto _ : state) {
    for (int q = half; q + length - half <= size; ++q) {
      std::ranges::fill(best, 1e9F);
      for (const auto& line : lines) {
        std::ranges::fill(sums, 0.0F);
        for (int k = 0; k < length; ++k) {
          const int offset = line.offsets[static_cast<std::size_t>(k)];
          const float* row = costs.row(static_cast<std::size_t>(q + k - half)).data();
          const int end = std::min(size, size - offset);
          for (int r = std::max(0, -offset); r < end; ++r)
            sums[static_cast<std::size_t>(r)] += row[r + offset];
        }
        for (std::size_t r = 0; r < sums.size(); ++r) best[r] = sums[r] < best[r] ? sums[r] : best[r];
      }
      benchmark::DoNotOptimize(best.data());
    }
  }
}
BENCHMARK(sequence_search_plain)->ArgsProduct({{1800}, {10, 20, 50}})->Unit(benchmark::kMillisecond);

void enhance(benchmark::State& state, place::Enhancement method) {
  vo::set_thread_count(1);
  const place::CostMatrix costs = random_costs(1800);
  for (auto _ : state) {
    place::CostMatrix enhanced = costs;
    place::enhance_contrast(enhanced, {.method = method});
    benchmark::DoNotOptimize(enhanced.values.data());
  }
}
BENCHMARK_CAPTURE(enhance, local, place::Enhancement::kLocal)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(enhance, standardise, place::Enhancement::kStandardise)->Unit(benchmark::kMillisecond);

/// All of it, descriptors to matches. Arguments: queries, references, sequence length, threads. The large
/// ones take half a minute, so they are apart; what counts is the time of a cell.
void search_streamed(benchmark::State& state, std::size_t kept_bytes) {
  vo::set_thread_count(static_cast<int>(state.range(3)));
  const Walks walks(state);
  const place::StreamedSearchOptions options{.search = {.length = static_cast<int>(state.range(2))},
                                             .kept_bytes = kept_bytes};
  for (auto _ : state)
    benchmark::DoNotOptimize(place::search_streamed(walks.query, walks.reference, options).data());
  state.counters["cell_time"] =
      benchmark::Counter(static_cast<double>(state.range(0)) * static_cast<double>(state.range(1)),
                         benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}
constexpr std::size_t kKept = place::StreamedSearchOptions{}.kept_bytes;
BENCHMARK_CAPTURE(search_streamed, default, kKept)
    ->Name("search_streamed")
    ->ArgsProduct({{2000, 3576}, {3576}, {10}, {1, 2}})
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(search_streamed, default, kKept)
    ->Name("large_search_streamed")
    ->ArgsProduct({{2000}, {100000, 1000000}, {10}, {1, 2}})
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(search_streamed, nothing_kept, 0)
    ->Name("large_search_streamed_nothing_kept")
    ->Args({2000, 100000, 10, 1})
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

// ---- The database ----

/// Opening a route, pictures left in the file. Argument: keyframes.
/// As `build` writes it by default: columns of blocks, and a thumbnail beside the preview.
void open_route(benchmark::State& state) {
  const auto keyframes = static_cast<std::size_t>(state.range(0));
  place::Traverse traverse;
  traverse.name = "walk";
  traverse.descriptors.emplace_back(blocks(keyframes, 1));
  traverse.thumbnails = random_descriptors(keyframes, 1);
  for (std::size_t i = 0; i < keyframes; ++i) {
    const auto place = static_cast<double>(i);
    traverse.keyframes.push_back(
        {.frame = static_cast<std::int64_t>(i), .time_s = place, .displacement = place});
  }
  place::Route route;
  route.traverses.push_back(std::move(traverse));
  route.learned.resize(1);
  const auto path = std::filesystem::temp_directory_path() / "retrace-place-bench.db";
  place::write_route(path, route);
  for (auto _ : state)
    benchmark::DoNotOptimize(place::read_route(path, {.previews = false}).traverses.data());
  std::filesystem::remove(path);
}
BENCHMARK(open_route)->Arg(100000)->Unit(benchmark::kMillisecond);

}  // namespace
