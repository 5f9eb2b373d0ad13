#pragma once

namespace retrace {

/// Makes SIGINT and SIGTERM end the program with exit code 130 or 143, after one line, and after removing all
/// that is half-written (`vo::discard_partial_paths`). Call it once, at the start.
void end_on_signals();

/// While an object of this class lives, the first SIGINT or SIGTERM does not end the program: it ends a
/// recording that has no end of its own (a camera, a stream), whose results so far are kept. A second one
/// ends the program as above.
class EndableReading {
 public:
  EndableReading();
  ~EndableReading();
  EndableReading(const EndableReading&) = delete;
  EndableReading& operator=(const EndableReading&) = delete;

  /// True once a signal has come.
  [[nodiscard]] static bool ended();
};

}  // namespace retrace
