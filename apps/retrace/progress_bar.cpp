#include "progress_bar.hpp"

#include <algorithm>
#include <cstdio>
#include <string>
#include <unistd.h>

#include <fmt/format.h>

#include <vo/base/error.hpp>
#include <vo/io/frame_source.hpp>

namespace retrace {
namespace {

std::string duration(double seconds) {
  const auto whole = static_cast<std::int64_t>(seconds + 0.5);
  return fmt::format("{}:{:02}", whole / 60, whole % 60);
}

}  // namespace

ProgressBar::ProgressBar(std::string_view walk)
    : start_(std::chrono::steady_clock::now()), shown_(start_), terminal_(::isatty(STDERR_FILENO) == 1) {
  if (vo::is_live(walk)) recording_.emplace();
}

ProgressBar::~ProgressBar() {
  if (drawn_) fmt::print(stderr, "\r\033[K");
}

vo::ProgressCallback ProgressBar::callback() {
  return [this](const vo::Progress& progress) { return show(progress); };
}

vo::ProgressCallback ProgressBar::whole_or_nothing() {
  return [this](const vo::Progress& progress) {
    if (!show(progress)) throw vo::Error(progress.stage, "was interrupted");
    return true;
  };
}

bool ProgressBar::show(const vo::Progress& progress) {
  using std::chrono::milliseconds;
  const auto now = std::chrono::steady_clock::now();
  if (progress.stage != stage_) {
    stage_ = progress.stage;
    start_ = now;
  }
  const auto interval = terminal_ ? milliseconds(100) : milliseconds(10000);
  if (now - shown_ < interval) return !(recording_ && EndableReading::ended());
  shown_ = now;

  const double elapsed_s = std::chrono::duration<double>(now - start_).count();
  const double rate = static_cast<double>(progress.done) / std::max(elapsed_s, 1e-9);
  std::string line = fmt::format("{}: {}", progress.stage, progress.done);
  if (progress.total && *progress.total > 0) {
    const double share =
        std::min(1.0, static_cast<double>(progress.done) / static_cast<double>(*progress.total));
    constexpr int kWidth = 24;
    const int filled = static_cast<int>(share * kWidth);
    const double left_s =
        static_cast<double>(std::max<std::int64_t>(*progress.total - progress.done, 0)) / rate;
    line = fmt::format("{} [{}{}] {:3.0f} % of {}", progress.stage, std::string(filled, '#'),
                       std::string(kWidth - filled, '.'), 100 * share, *progress.total);
    line += fmt::format("  {:.0f}/s  {} left", rate, duration(left_s));
  } else {
    line += fmt::format("  {:.0f}/s", rate);
  }
  if (terminal_) {
    fmt::print(stderr, "\r\033[K{}", line);
    drawn_ = true;
  } else {
    fmt::print(stderr, "{}\n", line);
  }
  std::fflush(stderr);
  return !(recording_ && EndableReading::ended());
}

}  // namespace retrace
