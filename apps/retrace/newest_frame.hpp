#pragma once

#include <condition_variable>
#include <cstdint>
#include <exception>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>

#include <vo/io/frame_source.hpp>

namespace retrace {

/// Reads a live source in a thread of its own, so that a reader who is too slow gets the newest picture and
/// not an old one; those in between are counted.
class NewestFrame {
 public:
  explicit NewestFrame(std::unique_ptr<vo::FrameSource> source);
  /// Waits for the picture that is being read.
  ~NewestFrame();
  NewestFrame(const NewestFrame&) = delete;
  NewestFrame& operator=(const NewestFrame&) = delete;

  /// The newest picture that was not given out yet, waiting for one; none at the end, or if none came for
  /// `patience_s`. Throws what reading threw.
  std::optional<vo::Frame> next(double patience_s);

  [[nodiscard]] std::int64_t dropped() const;
  /// Whether the source has ended.
  [[nodiscard]] bool ended() const;

 private:
  std::unique_ptr<vo::FrameSource> source_;
  mutable std::mutex mutex_;
  std::condition_variable came_;
  std::optional<vo::Frame> newest_;
  std::exception_ptr error_;
  bool ended_ = false, stop_ = false;
  std::int64_t dropped_ = 0;
  std::thread thread_;
};

}  // namespace retrace
