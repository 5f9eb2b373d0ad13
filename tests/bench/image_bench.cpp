#include <vector>

#include <benchmark/benchmark.h>
#include <opencv2/imgproc.hpp>

#include <vo/image/thumbnail.hpp>

namespace {

cv::Mat frame() {
  cv::setNumThreads(1);
  cv::Mat image(360, 640, CV_8UC3);
  cv::randu(image, 0, 256);
  return image;
}

void thumbnail(benchmark::State& state) {
  const cv::Mat image = frame();
  std::vector<std::uint8_t> out(64 * 32);
  for (auto _ : state) {
    vo::make_thumbnail(image, {}, out);
    benchmark::DoNotOptimize(out.data());
  }
}
BENCHMARK(thumbnail)->Unit(benchmark::kMicrosecond);

/// The peer: the same two steps by OpenCV.
void opencv_inter_area(benchmark::State& state) {
  const cv::Mat image = frame();
  cv::Mat grey, out;
  for (auto _ : state) {
    cv::cvtColor(image, grey, cv::COLOR_BGR2GRAY);
    cv::resize(grey, out, {64, 32}, 0, 0, cv::INTER_AREA);
    benchmark::DoNotOptimize(out.data);
  }
}
BENCHMARK(opencv_inter_area)->Unit(benchmark::kMicrosecond);

}  // namespace
