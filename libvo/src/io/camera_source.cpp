#include "io/frame_sources.hpp"
#include "vo/base/error.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

#include <fmt/format.h>
#include <opencv2/videoio.hpp>

namespace vo {
namespace {

class CameraSource final : public SampledSource {
 public:
  explicit CameraSource(int number) {
    bool opened = false;
    try {
      opened = capture_.open(number);
    } catch (const cv::Exception&) {
      opened = false;
    }
    if (!opened) throw Error(fmt::format("camera:{}", number), "cannot be opened", "a connected camera");
  }

  std::optional<Frame> next() override {
    cv::Mat image;
    if (!capture_.read(image) || image.empty()) return std::nullopt;
    const auto now = std::chrono::steady_clock::now();
    if (count_ == 0) {
      start_ = now;
      start_utc_s_ =
          std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
    }
    // Two frames may arrive within one tick of a coarse clock; times stay strictly increasing.
    const double elapsed_s = std::chrono::duration<double>(now - start_).count();
    last_time_s_ = count_ == 0 ? 0 : std::max(elapsed_s, std::nextafter(last_time_s_, HUGE_VAL));
    return Frame{.index = count_++, .time_s = last_time_s_, .image = std::move(image)};
  }

  [[nodiscard]] std::vector<cv::Mat> sample(std::size_t /*count*/) const override { return {}; }
  [[nodiscard]] std::optional<double> start_utc_s() const override { return start_utc_s_; }

 private:
  cv::VideoCapture capture_;
  std::chrono::steady_clock::time_point start_;
  std::optional<double> start_utc_s_;
  double last_time_s_ = 0;
  std::int64_t count_ = 0;
};

}  // namespace

std::unique_ptr<SampledSource> open_camera(int number) {
  return std::make_unique<CameraSource>(number);
}

}  // namespace vo
