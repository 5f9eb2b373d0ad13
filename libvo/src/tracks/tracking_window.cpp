#include "vo/tracks/tracking_window.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace vo {

TrackingWindow::TrackingWindow(int window) : window_(window) {
  if (window < 1 || window > kMaxWindow) {
    throw std::invalid_argument("TrackingWindow: window must be 1 to 5 frames");
  }
}

Tracks TrackingWindow::push(std::span<const Feature> points, std::span<const Match> matches) {
  std::vector<std::vector<Feature>> histories(points.size());
  for (const Match& match : matches) {
    if (match.from >= histories_.size() || match.to >= points.size()) {
      throw std::invalid_argument("TrackingWindow: a match names a point that is not there");
    }
    std::vector<Feature>& history = histories_[match.from];
    if (history.size() > static_cast<std::size_t>(window_)) history.erase(history.begin());
    histories[match.to] = std::move(history);
  }

  Tracks tracks;
  tracks.span = std::min(frames_, window_);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::vector<Feature>& history = histories[i];
    if (tracks.span > 0 && history.size() >= static_cast<std::size_t>(tracks.span)) {
      tracks.points.push_back({history[history.size() - static_cast<std::size_t>(tracks.span)], points[i]});
    }
    histories[i].push_back(points[i]);
  }
  histories_ = std::move(histories);
  ++frames_;
  return tracks;
}

}  // namespace vo
