#pragma once

#include <chrono>
#include <cstdint>
#include <string>

#include <vo/base/progress.hpp>

namespace retrace {

/// Shows progress on stderr: a bar with rate and time left on a terminal, otherwise a line every ten seconds.
/// Clears its bar when it goes out of scope. Ctrl-C stops the stage, whose results so far are kept.
class ProgressBar {
 public:
  ProgressBar();
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// A callback for successive stages, valid while this object lives; rates are those of the stage.
  [[nodiscard]] vo::ProgressCallback callback();

 private:
  bool show(const vo::Progress& progress);

  std::chrono::steady_clock::time_point start_;
  std::chrono::steady_clock::time_point shown_;
  std::string stage_;
  bool terminal_;
  bool drawn_ = false;
};

}  // namespace retrace
