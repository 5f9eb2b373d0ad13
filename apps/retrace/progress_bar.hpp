#pragma once

#include "interruption.hpp"

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include <vo/base/progress.hpp>

namespace retrace {

/// Shows progress on stderr: a bar with rate and time left on a terminal, otherwise a line every ten seconds.
/// Clears its bar when it goes out of scope. Where a walk goes on until it is ended, Ctrl-C ends the stage,
/// whose results so far are kept.
class ProgressBar {
 public:
  /// `walk`: what is read, if a walk is (`vo::is_live`).
  explicit ProgressBar(std::string_view walk = {});
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// A callback for successive stages, valid while this object lives; rates are those of the stage.
  [[nodiscard]] vo::ProgressCallback callback();

  /// The same where half a result is of no use: throws `vo::Error` if the stage was ended.
  [[nodiscard]] vo::ProgressCallback whole_or_nothing();

 private:
  bool show(const vo::Progress& progress);

  std::chrono::steady_clock::time_point start_;
  std::chrono::steady_clock::time_point shown_;
  std::string stage_;
  bool terminal_;
  bool drawn_ = false;
  std::optional<EndableReading> recording_;
};

}  // namespace retrace
