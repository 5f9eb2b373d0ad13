// What limits SURF: prints, for each of its stages on one thread and one simulated frame of 640x360, how much
// of the processor's arithmetic, first- and second-level cache and gathers it uses. The roofs are measured in
// the same run; what a stage does is counted from its loops, which are named beside the counts. The largest
// share is the stage's roof. Needs AVX2.
#include "frames.hpp"

#include <algorithm>
#include <chrono>
#include <functional>
#include <immintrin.h>
#include <vector>

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <vo/base/parallel.hpp>
#include <vo/surf/descriptor.hpp>
#include <vo/surf/integral_image.hpp>
#include <vo/surf/orientation.hpp>
#include <vo/surf/smooth_pyramid.hpp>
#include <vo/surf/surf.hpp>
#include <vo/tracks/matching.hpp>

namespace {

/// Least time of a call, over about half a second of calls.
double seconds(const std::function<void()>& call) {
  using Clock = std::chrono::steady_clock;
  double least = 1e9;
  const auto begin = Clock::now();
  do {
    const auto start = Clock::now();
    call();
    least = std::min(least, std::chrono::duration<double>(Clock::now() - start).count());
  } while (std::chrono::duration<double>(Clock::now() - begin).count() < 0.5);
  return least;
}

// ---- roofs ----

// Each keeps enough chains in registers that none waits for another. What clobbers memory keeps the compiler
// from taking loads out of the loop.

__attribute__((target("avx2"))) void arithmetic(int rounds) {
  __m256 a0, a1, a2, a3, a4, a5, b0, b1, b2, b3, b4, b5;
  a0 = a1 = a2 = a3 = a4 = a5 = b0 = b1 = b2 = b3 = b4 = b5 = _mm256_set1_ps(1);
  const __m256 factor = _mm256_set1_ps(1.0000001F), term = _mm256_set1_ps(1e-9F);
  for (int i = 0; i < rounds; ++i) {
    a0 = _mm256_mul_ps(a0, factor);
    b0 = _mm256_add_ps(b0, term);
    a1 = _mm256_mul_ps(a1, factor);
    b1 = _mm256_add_ps(b1, term);
    a2 = _mm256_mul_ps(a2, factor);
    b2 = _mm256_add_ps(b2, term);
    a3 = _mm256_mul_ps(a3, factor);
    b3 = _mm256_add_ps(b3, term);
    a4 = _mm256_mul_ps(a4, factor);
    b4 = _mm256_add_ps(b4, term);
    a5 = _mm256_mul_ps(a5, factor);
    b5 = _mm256_add_ps(b5, term);
  }
  __m256 sums[] = {a0, a1, a2, a3, a4, a5, b0, b1, b2, b3, b4, b5};
  benchmark::DoNotOptimize(sums);
}

__attribute__((target("avx2"))) __m256i load(const std::uint8_t* from) {
  return _mm256_loadu_si256(reinterpret_cast<const __m256i*>(from));
}

__attribute__((target("avx2"))) void read(const cv::Mat& bytes) {
  __m256i a = _mm256_setzero_si256(), b = a, c = a, d = a;
  for (const std::uint8_t *at = bytes.data, *end = at + bytes.total(); at != end; at += 256) {
    a = _mm256_xor_si256(a, _mm256_xor_si256(load(at), load(at + 32)));
    b = _mm256_xor_si256(b, _mm256_xor_si256(load(at + 64), load(at + 96)));
    c = _mm256_xor_si256(c, _mm256_xor_si256(load(at + 128), load(at + 160)));
    d = _mm256_xor_si256(d, _mm256_xor_si256(load(at + 192), load(at + 224)));
  }
  __m256i sums[] = {a, b, c, d};
  benchmark::DoNotOptimize(sums);
}

__attribute__((target("avx2"))) void gather(const cv::Mat& bytes, int rounds) {
  const __m256i index = _mm256_setr_epi32(0, 71, 142, 213, 284, 355, 426, 497);
  const int* from = reinterpret_cast<const int*>(bytes.data);
  __m256i a = _mm256_setzero_si256(), b = a, c = a, d = a;
  for (int i = 0; i < rounds; ++i) {
    benchmark::ClobberMemory();
    a = _mm256_xor_si256(a, _mm256_i32gather_epi32(from, index, 2));
    b = _mm256_xor_si256(b, _mm256_i32gather_epi32(from + 16, index, 2));
    c = _mm256_xor_si256(c, _mm256_i32gather_epi32(from + 32, index, 2));
    d = _mm256_xor_si256(d, _mm256_i32gather_epi32(from + 48, index, 2));
  }
  __m256i sums[] = {a, b, c, d};
  benchmark::DoNotOptimize(sums);
}

/// What the processor does in a second.
struct Roofs {
  double operations, l1_bytes, l2_bytes, gathers;
};

Roofs measure_roofs() {
  constexpr int kRounds = 10000;
  const cv::Mat near(1, 16 << 10, CV_8U, cv::Scalar(1)), far(1, 384 << 10, CV_8U, cv::Scalar(1));  // aligned
  return {.operations = 12.0 * 8 * kRounds / seconds([] { arithmetic(kRounds); }),
          .l1_bytes = 64.0 * static_cast<double>(near.total()) / seconds([&] {
                        for (int i = 0; i < 64; ++i) read(near);
                      }),
          .l2_bytes = static_cast<double>(far.total()) / seconds([&] { read(far); }),
          .gathers = 4.0 * kRounds / seconds([&] { gather(near, kRounds); })};
}

// ---- stages ----

/// What a stage does, and in which time. Operations are on one value each; L1 bytes are what its loops load
/// and store, L2 bytes what does not stay in the first-level cache from one row, or point, to the next.
struct Stage {
  const char* name;
  double time_s, operations, l1_bytes, l2_bytes, gathers;
};

std::vector<Stage> measure_stages(const cv::Mat& grey, const vo::SurfOptions& options, std::size_t* points) {
  const vo::IntegralImage integral = vo::integral_image(grey);
  vo::Features features = vo::detect_surf(grey, options);
  *points = features.size();
  const float max_scale_px = std::ranges::max(features.points, {}, &vo::Feature::scale_px).scale_px;
  const vo::SmoothPyramid pyramid = vo::smooth_pyramid(grey, 3 * max_scale_px);
  const auto pixels = static_cast<double>(grey.total());
  const auto count = static_cast<double>(features.size());
  double samples = 0;  // of all octaves
  for (int o = 0; o < options.detector.octaves; ++o) samples += pixels / (1 << 2 * o);
  const double responses = samples * options.detector.intervals;
  double smoothed = 0;  // pixels of the levels that are filtered with 5 x 5
  for (std::size_t i = 1; i < pyramid.levels.size(); i += 2)
    smoothed += pyramid.levels[i].width * pyramid.levels[i].height;

  std::vector<float> descriptor(64);
  return {
      // A running sum, and the row above.
      {"integral image", seconds([&] { benchmark::DoNotOptimize(vo::integral_image(grey)); }), 2 * pixels,
       9 * pixels, 5 * pixels, 0},
      // kernels/hessian.hpp: 18 sums of integers and 10 operations on floats to a response, 20 loads and 4
      // stores; maxima_row: 3 loads and comparisons for most.
      {"Hessian and maxima",
       seconds([&] { benchmark::DoNotOptimize(vo::detect_blobs(integral, options.detector)); }),
       31 * responses, 4.0 * 27 * responses, 4 * samples, 0},
      // 16 operations on 16 bits to a pixel, of which one instruction does twice as many as of floats.
      {"smooth pyramid",
       seconds([&] { benchmark::DoNotOptimize(vo::smooth_pyramid(grey, 3 * max_scale_px)); }),
       (8 * pixels + 18 * smoothed) / 2, 14 * pixels + 24 * smoothed, 3 * pixels + 4 * smoothed, 0},
      // kernels/sampling.hpp: 28 operations and 2 gathers to a sample of 15 x 16; kernels/orientation.hpp: 20
      // and 6 for each of 8 harmonics to a gradient of 13 x 16; orientation.cpp: 64 directions of 8
      // harmonics.
      {"orientations", seconds([&] {
         for (const vo::Feature& point : features.points)
           benchmark::DoNotOptimize(vo::orientation(pyramid, point));
       }),
       count * (28 * 15 * 16 + (20 + 6 * 8) * 13 * 16 + 4 * 64 * 8), 4 * count * (2 * 15 * 16 + 9 * 13 * 16),
       0, count * 2 * 15 * 16 / 8},
      // 21 x 24 samples; kernels/descriptor.hpp: 6 operations to a wavelet pair of 20 x 24, then 8 to each in
      // the 9 rows of a subregion, four times, and 4 x 4 x 4 sums over 24 columns.
      {"descriptors", seconds([&] {
         for (const vo::Feature& point : features.points) vo::describe(pyramid, point, descriptor);
       }),
       count * (28 * 21 * 24 + 6 * 20 * 24 + 8 * 4 * 9 * 24 + 2 * 64 * 24),
       4 * count * (4 * 21 * 24 + 6 * 20 * 24 + 2 * 4 * 9 * 24 + 2 * 64 * 24), 0, count * 2 * 21 * 24 / 8},
  };
}

}  // namespace

int main() {
  vo::set_thread_count(1);
  const cv::Mat grey = bench::street_frames()[0];
  const vo::SurfOptions options{.detector = {.threshold = 5, .max_points = 850}};
  const Roofs roofs = measure_roofs();
  std::size_t points = 0;
  const std::vector<Stage> stages = measure_stages(grey, options, &points);
  const double whole_s = seconds([&] { benchmark::DoNotOptimize(vo::detect_surf(grey, options)); });

  fmt::print(
      "Roofs: {:.0f} G operations/s, L1 {:.0f} GB/s, L2 {:.0f} GB/s, {:.2f} G gathers/s. {} points.\n\n",
      roofs.operations / 1e9, roofs.l1_bytes / 1e9, roofs.l2_bytes / 1e9, roofs.gathers / 1e9, points);
  fmt::print(
      "| stage | ms | operations to a byte of L2 | arithmetic | L1 | L2 | gathers "
      "|\n|---|---|---|---|---|---|---|\n");
  double sum_s = 0;
  for (const Stage& s : stages) {
    sum_s += s.time_s;
    const auto share = [&](double amount, double roof) { return 100 * amount / roof / s.time_s; };
    fmt::print("| {} | {:.2f} | {} | {:.0f} % | {:.0f} % | {:.0f} % | {:.0f} % |\n", s.name, 1e3 * s.time_s,
               s.l2_bytes > 0 ? fmt::format("{:.1f}", s.operations / s.l2_bytes) : "",
               share(s.operations, roofs.operations), share(s.l1_bytes, roofs.l1_bytes),
               share(s.l2_bytes, roofs.l2_bytes), share(s.gathers, roofs.gathers));
  }
  fmt::print("| all ({:.2f} ms in one call) | {:.2f} | | | | | |\n", 1e3 * whole_s, 1e3 * sum_s);
}
