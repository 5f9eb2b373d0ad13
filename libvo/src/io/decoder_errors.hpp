#pragma once

#include <atomic>

namespace vo {

/// Counts what FFmpeg's decoders say is wrong, one decoder by itself: many give out a damaged picture without
/// any other sign of it than a line in FFmpeg's log. Nothing of that log is printed.
class DecoderErrors {
 public:
  DecoderErrors();
  ~DecoderErrors();
  DecoderErrors(const DecoderErrors&) = delete;
  DecoderErrors& operator=(const DecoderErrors&) = delete;

  /// For `AVCodecContext::opaque`, which the decoder's threads share.
  [[nodiscard]] void* key() { return this; }

  /// Errors so far.
  [[nodiscard]] int count() const { return count_.load(); }

  void add() { ++count_; }

 private:
  std::atomic<int> count_{0};
};

}  // namespace vo
