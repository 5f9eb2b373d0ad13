// SURF and its matching beside dlib's SURF on one simulated frame of 640x360. `time_per_point` is for
// detection, orientation and descriptor of one point.
#include "dlib_surf.hpp"
#include "frames.hpp"

#include <benchmark/benchmark.h>

#include <vo/base/parallel.hpp>
#include <vo/surf/integral_image.hpp>
#include <vo/surf/smooth_pyramid.hpp>
#include <vo/surf/surf.hpp>
#include <vo/tracks/matching.hpp>

namespace {

constexpr std::size_t kPoints = 850;

const std::vector<cv::Mat>& frames() {
  static const std::vector<cv::Mat> result = bench::street_frames();
  return result;
}

vo::SurfOptions options_for(std::size_t points) {
  return {.detector = {.threshold = 5, .max_points = points}};
}

void report_points(benchmark::State& state, std::size_t points) {
  state.counters["points"] = static_cast<double>(points);
  state.counters["time_per_point"] =
      benchmark::Counter(static_cast<double>(points),
                         benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

/// Argument: threads.
void surf(benchmark::State& state, bool upright, bool extended) {
  vo::set_thread_count(static_cast<int>(state.range(0)));
  vo::SurfOptions options = options_for(kPoints);
  options.upright = upright;
  options.extended = extended;
  std::size_t points = 0;
  const cv::Mat& frame = frames()[0];  // drawn before the clock runs
  for (auto _ : state) points = vo::detect_surf(frame, options).size();
  report_points(state, points);
}
BENCHMARK_CAPTURE(surf, plain, false, false)->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_CAPTURE(surf, upright, true, false)->Arg(1)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_CAPTURE(surf, extended, false, true)->Arg(1)->Unit(benchmark::kMillisecond)->UseRealTime();

/// With the defaults of `SurfOptions`.
void surf_default(benchmark::State& state) {
  vo::set_thread_count(static_cast<int>(state.range(0)));
  std::size_t points = 0;
  const cv::Mat& frame = frames()[0];
  for (auto _ : state) points = vo::detect_surf(frame).size();
  report_points(state, points);
}
BENCHMARK(surf_default)->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond)->UseRealTime();

void dlib_surf(benchmark::State& state) {
  const bench::DlibImage image = bench::dlib_image(frames()[0]);
  // The strongest that leave 850 after those near the rim are dropped, so that none is described in vain.
  const std::size_t wanted = kPoints;
  double threshold = 100;
  while (threshold > 0.1 && dlib::get_surf_points(image, 100000, threshold).size() < wanted)
    threshold *= 0.95;
  std::size_t points = 0;
  for (auto _ : state) points = dlib::get_surf_points(image, 100000, threshold).size();
  report_points(state, points);
}
BENCHMARK(dlib_surf)->Unit(benchmark::kMillisecond)->UseRealTime();

void integral_image(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(vo::integral_image(frames()[0]));
}
BENCHMARK(integral_image)->Unit(benchmark::kMillisecond);

void detect_blobs(benchmark::State& state) {
  vo::set_thread_count(1);
  const auto integral = vo::integral_image(frames()[0]);
  for (auto _ : state) benchmark::DoNotOptimize(vo::detect_blobs(integral, options_for(kPoints).detector));
}
BENCHMARK(detect_blobs)->Unit(benchmark::kMillisecond);

void smooth_pyramid(benchmark::State& state) {
  vo::set_thread_count(1);
  for (auto _ : state) benchmark::DoNotOptimize(vo::smooth_pyramid(frames()[0], 20));
}
BENCHMARK(smooth_pyramid)->Unit(benchmark::kMillisecond);

/// Two consecutive frames of 800 points; arguments: threads, largest displacement in pixels (0: any). `agree`
/// is the share of its matches that a search without a limit finds as well.
void matching(benchmark::State& state) {
  vo::set_thread_count(static_cast<int>(state.range(0)));
  const vo::Features from = vo::detect_surf(frames()[0], options_for(800));
  const vo::Features to = vo::detect_surf(frames()[1], options_for(800));
  const vo::MatchOptions options{.max_displacement_px = static_cast<double>(state.range(1))};
  std::vector<vo::Match> matches;
  for (auto _ : state) matches = vo::match_features(from, to, options);
  const auto exact = vo::match_features(from, to);
  const auto agree = std::ranges::count_if(matches, [&](const vo::Match& match) {
    return std::ranges::any_of(
        exact, [&](const vo::Match& other) { return other.from == match.from && other.to == match.to; });
  });
  state.counters["matches"] = static_cast<double>(matches.size());
  state.counters["agree"] = static_cast<double>(agree) / static_cast<double>(matches.size());
}
BENCHMARK(matching)->Args({1, 0})->Args({2, 0})->Args({1, 100})->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
