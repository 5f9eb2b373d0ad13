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
  for (const auto& comparisons : errors.by_span) {
    const auto begin = comparisons.begin() + static_cast<std::ptrdiff_t>(range.begin);
    part.by_span.emplace_back(begin, begin + static_cast<std::ptrdiff_t>(range.size()));
    for (std::size_t i = 0; i < range.size(); ++i)
      if (i + part.by_span.back()[i].frames >= range.size()) part.by_span.back()[i] = {};
  }
  return part;
}

}  // namespace

std::vector<std::optional<double>> predict_displacement(const AlignmentErrors& errors,
                                                        std::span<const double> time_s,
                                                        const std::vector<bool>& usable,
                                                        std::span<const std::optional<double>> known,
                                                        FrameRange from, FrameRange target,
                                                        const LearnedRelationOptions& options) {
  const std::size_t frames = errors.frames();
  if (time_s.size() != frames || usable.size() != frames || known.size() != frames)
    throw std::invalid_argument("predict_displacement: one time, flag and displacement per frame expected");
  if (from.begin > from.end || from.end > frames || target.begin > target.end || target.end > frames)
    throw std::invalid_argument("predict_displacement: ranges of the walk's frames expected");

  const FrameRange both{std::min(from.begin, target.begin), std::max(from.end, target.end)};
  std::vector<double> displacement(both.size(), 0);
  std::vector<bool> learn(both.size(), false);
  double known_sum = 0, known_s = 0;
  for (std::size_t i = std::max<std::size_t>(from.begin, 1); i < from.end; ++i) {
    if (!known[i] || !usable[i]) continue;
    displacement[i - both.begin] = *known[i];
    learn[i - both.begin] = true;
    known_sum += *known[i];
    known_s += time_s[i] - time_s[i - 1];
  }
  if (!(known_sum > 0)) return {};
  const AlignmentErrors part = part_of(errors, both);
  const MotionModel model = learn_motion_model(part, displacement, learn);
  if (!model.learned()) return {};
  const auto predicted = apply_motion_model(part, model, time_s.subspan(both.begin, both.size()),
                                            options.separations, options.max_speed * known_sum / known_s);
  double predicted_sum = 0;
  for (std::size_t i = 0; i < learn.size(); ++i) predicted_sum += learn[i] ? predicted[i].value_or(0) : 0;
  if (!(predicted_sum > 0)) return {};
  std::vector<std::optional<double>> result;
  for (std::size_t i = target.begin; i < target.end; ++i) {
    result.push_back(predicted[i - both.begin]);
    if (result.back()) *result.back() *= known_sum / predicted_sum;
  }
  return result;
}

}  // namespace vo
