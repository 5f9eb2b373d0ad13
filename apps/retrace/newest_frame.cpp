#include "newest_frame.hpp"

#include <chrono>
#include <utility>

namespace retrace {

NewestFrame::NewestFrame(std::unique_ptr<vo::FrameSource> source)
    : source_(std::move(source)), thread_([this] {
        try {
          for (;;) {
            std::optional<vo::Frame> frame = source_->next();
            const std::lock_guard lock(mutex_);
            if (!frame || stop_) break;
            if (newest_) ++dropped_;
            newest_ = std::move(frame);
            came_.notify_one();
          }
        } catch (...) {
          const std::lock_guard lock(mutex_);
          error_ = std::current_exception();
        }
        const std::lock_guard lock(mutex_);
        ended_ = true;
        came_.notify_one();
      }) {}

NewestFrame::~NewestFrame() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  thread_.join();
}

std::optional<vo::Frame> NewestFrame::next(double patience_s) {
  std::unique_lock lock(mutex_);
  came_.wait_for(lock, std::chrono::duration<double>(patience_s), [&] { return newest_ || ended_; });
  if (!newest_ && error_) std::rethrow_exception(error_);
  return std::exchange(newest_, std::nullopt);
}

std::int64_t NewestFrame::dropped() const {
  const std::lock_guard lock(mutex_);
  return dropped_;
}

bool NewestFrame::ended() const {
  const std::lock_guard lock(mutex_);
  return ended_;
}

}  // namespace retrace
