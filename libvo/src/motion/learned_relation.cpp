#include "vo/motion/learned_relation.hpp"

#include "vo/motion/motion_model.hpp"

#include <algorithm>
#include <cstddef>
#include <stdexcept>

namespace vo {
namespace {

/// The errors among the frames of a range.
AlignmentErrors part_of(const AlignmentErrors& errors, FrameRange range) {
  AlignmentErrors part;
  for (std::size_t s = 0; s < errors.by_separation.size(); ++s) {
    const std::size_t count = range.size() > s ? range.size() - s : 0;
    const auto begin =
        errors.by_separation[s].begin() + static_cast<std::ptrdiff_t>(count > 0 ? range.begin : 0);
    part.by_separation.emplace_back(begin, begin + static_cast<std::ptrdiff_t>(count));
  }
  return part;
}

}  // namespace

std::vector<double> predict_displacement(const AlignmentErrors& errors, const std::vector<bool>& usable,
                                         std::span<const std::optional<double>> known, FrameRange from,
                                         FrameRange target, const LearnedRelationOptions& options) {
  const std::size_t frames = errors.frames();
  if (usable.size() != frames || known.size() != frames)
    throw std::invalid_argument("predict_displacement: one flag and one displacement per frame expected");
  if (from.begin > from.end || from.end > frames || target.begin > target.end || target.end > frames)
    throw std::invalid_argument("predict_displacement: ranges of the walk's frames expected");

  const FrameRange both{std::min(from.begin, target.begin), std::max(from.end, target.end)};
  std::vector<double> displacement(both.size(), 0);
  std::vector<bool> learn(both.size(), false);
  double known_sum = 0, count = 0;
  for (std::size_t i = from.begin; i < from.end; ++i) {
    if (!known[i] || !usable[i]) continue;
    displacement[i - both.begin] = *known[i];
    learn[i - both.begin] = true;
    known_sum += *known[i];
    ++count;
  }
  if (!(known_sum > 0)) return {};
  const AlignmentErrors part = part_of(errors, both);
  const MotionModel model = learn_motion_model(part, displacement, learn);
  if (!model.learned()) return {};
  const std::vector<double> predicted =
      apply_motion_model(part, model, options.separations, options.max_speed * known_sum / count);
  double predicted_sum = 0;
  for (std::size_t i = 0; i < learn.size(); ++i) predicted_sum += learn[i] ? predicted[i] : 0;
  if (!(predicted_sum > 0)) return {};
  std::vector<double> result;
  for (std::size_t i = target.begin; i < target.end; ++i)
    result.push_back(predicted[i - both.begin] * known_sum / predicted_sum);
  return result;
}

}  // namespace vo
