#include "followed_source.hpp"

#include <utility>

#include <fmt/format.h>

#include <vo/base/error.hpp>

namespace retrace {
namespace {

/// True for what does not wait for a slow reader, as standard input does.
bool does_not_wait(const std::string& walk) {
  return vo::is_live(walk) && walk != "-";
}

}  // namespace

FollowedSource::FollowedSource(std::string walk, std::unique_ptr<vo::FrameSource> source, double patience_s)
    : walk_(std::move(walk)), patience_s_(patience_s) {
  if (does_not_wait(walk_)) {
    newest_.emplace(std::move(source));
  } else {
    source_ = std::move(source);
  }
}

std::optional<vo::Frame> FollowedSource::next() {
  std::optional<vo::Frame> frame;
  if (EndableReading::ended()) return frame;
  try {
    frame = newest_ ? newest_->next(patience_s_) : source_->next();
  } catch (const vo::Error& error) {
    trouble_ = error.what();
  }
  if (newest_) skipped_ = newest_->dropped();
  if (newest_ && !frame) broke_off_ = newest_->ended();
  return frame;
}

void FollowedSource::check_end() const {
  if (!trouble_.empty()) throw vo::Error(walk_, trouble_, "a source that goes on; what was seen is kept");
  if (newest_ && !EndableReading::ended())
    throw vo::Error(walk_,
                    broke_off_ ? "sent no picture more: it ended"
                               : fmt::format("sent no picture for {:g} s", patience_s_),
                    "a camera that goes on; what was seen is kept");
}

std::vector<std::string> FollowedSource::warnings() const {
  if (source_) return source_->warnings();
  if (skipped_ == 0) return {};
  return {fmt::format("{}: {} frames were skipped, to keep up", walk_, skipped_)};
}

std::optional<double> FollowedSource::start_utc_s() const {
  return source_ ? source_->start_utc_s() : std::nullopt;
}

}  // namespace retrace
