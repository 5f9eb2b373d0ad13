#include "vo/motion/published_hybrid.hpp"

#include "vo/base/frame_range.hpp"
#include "vo/motion/motion_model.hpp"

#include <cstddef>
#include <limits>
#include <optional>
#include <stdexcept>

namespace vo {
namespace {

/// Displacement of every frame by its error, as the segment of frame `last` up to it teaches; empty if it
/// teaches nothing.
std::vector<std::optional<double>> learned_from(const MotionEvidence& evidence, std::size_t last) {
  const std::vector<TrackedDisplacement>& track = evidence.track->frames;
  std::vector<double> displacement(track.size(), 0);
  std::vector<bool> known(track.size(), false);
  for (std::size_t i = 1; i <= last; ++i) {
    if (!track[i].valid || track[i].segment != track[last].segment || !evidence.errors_known[i]) continue;
    displacement[i] = track[i].displacement;
    known[i] = true;
  }
  const MotionModel model = learn_motion_model(*evidence.errors, displacement, known);
  if (!model.learned()) return {};
  return apply_motion_model(*evidence.errors, model, evidence.time_s, 1,
                            std::numeric_limits<double>::infinity());
}

}  // namespace

std::vector<FrameDisplacement> hybrid_as_published(const MotionEvidence& evidence) {
  check(evidence);
  if (evidence.track == nullptr) throw std::invalid_argument("hybrid_as_published: a track expected");
  const std::vector<TrackedDisplacement>& track = evidence.track->frames;
  std::vector<FrameDisplacement> frames(track.size());
  std::vector<bool> lost(track.size(), false);
  for (std::size_t i = 1; i < track.size(); ++i) {
    lost[i] = !track[i].valid;
    if (track[i].valid) frames[i] = {track[i].displacement, track[i].sigma, DisplacementSource::kTrack};
  }
  if (evidence.errors == nullptr) return frames;
  std::vector<std::optional<double>> learned;
  for (const FrameRange& range : marked_ranges(lost)) {
    if (range.begin > 1) {
      std::vector<std::optional<double>> by_last = learned_from(evidence, range.begin - 1);
      if (!by_last.empty()) learned = std::move(by_last);
    }
    for (std::size_t i = range.begin; i < range.end && !learned.empty(); ++i) {
      if (!learned[i]) continue;
      frames[i] = {*learned[i], kUsualAlignmentError * *learned[i], DisplacementSource::kAlignmentError};
    }
  }
  return frames;
}

}  // namespace vo
