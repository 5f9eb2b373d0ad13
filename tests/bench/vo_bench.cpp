#include "frames.hpp"

#include <vector>

#include <benchmark/benchmark.h>
#include <opencv2/core.hpp>

#include <vo/base/parallel.hpp>
#include <vo/visual_odometry/monocular_vo.hpp>

namespace {

/// Visual odometry of five seconds of a simulated street, 640 x 360: frames a second.
void monocular_vo(benchmark::State& state) {
  cv::setNumThreads(1);
  vo::set_thread_count(static_cast<int>(state.range(0)));
  const simulate::WalkSimulator walk(simulate::Options{.length_m = 30});
  std::vector<cv::Mat> frames;
  std::vector<double> time_s;
  constexpr int kFrames = 125, kRate_hz = 25;
  for (int i = 0; i < kFrames; ++i) {
    frames.push_back(bench::grey_640x360(walk.render(100 + i)));
    time_s.push_back(static_cast<double>(i) / kRate_hz);
  }
  for (auto _ : state) benchmark::DoNotOptimize(vo::monocular_vo(frames, time_s));
  state.SetItemsProcessed(state.iterations() * kFrames);
}
BENCHMARK(monocular_vo)->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
