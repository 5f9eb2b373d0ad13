#include "vo/motion/motion_follower.hpp"

#include "vo/base/clock.hpp"
#include "vo/base/median.hpp"
#include "vo/motion/standing.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace vo {
namespace {

constexpr double kLearnEvery_s = 1;      // a model changes slowly
constexpr double kLeastLearned_s = 1.5;  // of motion, before a model says more than the mean speed
constexpr double kJump = 2;        // times the usual error: a turn or a jolt, which would spoil the averages
constexpr double kDistant_s = 15;  // frames so far apart show places that have nothing in common
constexpr std::size_t kDistantFrames = 30, kDistantErrors = 60;
// Of unrelated pictures where none were seen yet: drawn and real walks have 0.7 to 1.
constexpr double kUsualDistantError = 0.8;
// Variance of the distance moved for each second, s^2: what a walk's speed by alignment error differs from
// the true one by from second to second, and by what a walker's pace differs from the mean.
constexpr double kVariance = 0.1, kVarianceUnseen = 0.4;

}  // namespace

MotionFollower::MotionFollower(const MotionFollowerOptions& options)
    : options_(options), means_(options.spans) {
  if (options.spans < 1 || options.separations < 1 || options.separations > options.spans ||
      !(options.max_speed > 0) || !(options.memory_s > 0) || !(options.standing_span_s >= 0))
    throw std::invalid_argument("MotionFollower: options within their ranges expected");
}

const MotionFollower::Past* MotionFollower::nearest(double time_s, double within_s) const {
  const Past* best = nullptr;
  for (const Past& past : past_) {
    const double off = std::abs(past.time_s - time_s);
    if (off <= within_s && (best == nullptr || off < std::abs(best->time_s - time_s))) best = &past;
  }
  return best;
}

bool MotionFollower::stands(const Past& now) {
  if (distant_.empty() || now.time_s - distant_.back().time_s >= 1) {
    for (const Past& past : distant_) {
      if (now.time_s - past.time_s > kDistant_s + 1 || now.time_s - past.time_s < kDistant_s) continue;
      if (distant_errors_.size() == kDistantErrors) distant_errors_.erase(distant_errors_.begin());
      distant_errors_.push_back(alignment_error(past.pixels, now.pixels));
      break;
    }
    distant_.push_back(now);
    if (distant_.size() > kDistantFrames) distant_.pop_front();
  }
  if (options_.standing_span_s == 0) return false;
  const double half_s = options_.standing_span_s / 2, within_s = 0.2 * half_s;
  const Past* const middle = nearest(now.time_s - half_s, within_s);
  const Past* const first = nearest(now.time_s - 2 * half_s, within_s);
  if (middle == nullptr || first == nullptr || !middle->seen || !first->seen) return false;
  constexpr std::size_t kEnough = 10;
  const double distant = distant_errors_.size() < kEnough ? kUsualDistantError : median(distant_errors_);
  const double most_unlike =
      std::max({alignment_error(first->pixels, now.pixels), alignment_error(middle->pixels, now.pixels),
                alignment_error(first->pixels, middle->pixels)}) /
      distant;
  constexpr StandingOptions kUsual;
  if (most_unlike < kUsual.alike) return true;
  if (most_unlike >= kUsual.alike_for_long) return false;
  // As `standing_frames`, which also looks ahead. Of the distant pictures there is one for each second.
  const double long_ago_s = now.time_s - kLongSpans * options_.standing_span_s;
  const auto long_ago = std::ranges::find_if(
      distant_, [&](const Past& past) { return std::abs(past.time_s - long_ago_s) <= 0.6; });
  return long_ago != distant_.end() &&
         alignment_error(long_ago->pixels, now.pixels) < kUsual.alike_for_long * distant;
}

void MotionFollower::learn(const std::vector<Comparison>& compared, double since_s) {
  const double kept = std::exp(-since_s / options_.memory_s);
  for (std::size_t k = 0; k < means_.size(); ++k) {
    Mean& mean = means_[k];
    if (!compared[k].made()) continue;
    const auto error = static_cast<double>(compared[k].error);
    constexpr double kFirst = 20;  // frames, before which nothing is usual
    if (mean.weight > kFirst && error > kJump * mean.error / mean.weight) continue;
    mean.weight = mean.weight * kept + 1;
    mean.error = mean.error * kept + error;
    mean.seconds = mean.seconds * kept + static_cast<double>(compared[k].seconds);
  }
  moving_s_ += since_s;
}

FollowedMotion MotionFollower::push(std::span<const std::uint8_t> normalised, double time_s, bool seen) {
  if (!past_.empty() && (!(time_s > past_.back().time_s) || normalised.size() != past_.back().pixels.size()))
    throw std::invalid_argument("MotionFollower: pictures of one size by increasing time expected");
  Past now{time_s, {normalised.begin(), normalised.end()}, seen};
  FollowedMotion motion;
  if (past_.empty()) {
    past_.push_back(std::move(now));
    return motion;
  }
  const double since_s = time_s - past_.back().time_s;
  // As `alignment_errors`: spans are longer where frames come slowly.
  constexpr double kUnusual = 4;  // as `clock_gaps`
  const auto usual_s = [&] { return clock_s_ / static_cast<double>(intervals_); };
  if (intervals_ == 0 || since_s < std::max(kShortestGap_s, kUnusual * usual_s())) {
    clock_s_ += since_s;
    ++intervals_;
  }
  span_s_ = std::max(kAlignmentSpan_s, usual_s() / 2);

  std::vector<Comparison> compared(options_.spans);
  if (seen) {
    std::size_t back = past_.size();
    for (std::size_t k = 0; k < compared.size() && back > 0; ++k) {
      const double at_s = time_s - static_cast<double>(k + 1) * span_s_;
      while (back > 1 && std::abs(past_[back - 2].time_s - at_s) <= std::abs(past_[back - 1].time_s - at_s))
        --back;
      const Past& past = past_[back - 1];
      if (!past.seen || std::abs(past.time_s - at_s) > span_s_ / 2 * 1.0001) continue;
      compared[k] = {.frames = static_cast<std::uint32_t>(past_.size() - back + 1),
                     .seconds = static_cast<float>(time_s - past.time_s),
                     .error = static_cast<float>(alignment_error(past.pixels, normalised))};
    }
  }
  motion.standing = seen && stands(now);
  if (seen && !motion.standing) learn(compared, since_s);
  if (moving_s_ >= kLeastLearned_s && moving_s_ - learned_at_s_ >= kLearnEvery_s) {
    learned_at_s_ = moving_s_;
    MeanErrors means{{0}, {0}};
    for (const Mean& mean : means_) {
      if (mean.weight < 1) continue;
      const double seconds = mean.seconds / mean.weight;
      if (!(seconds > means.seconds.back())) continue;
      means.seconds.push_back(seconds);
      means.error.push_back(mean.error / mean.weight);
    }
    model_ = learn_motion_model(means);
    curve_ = SeparationCurve(model_);
  }

  motion.moved_s = since_s;
  motion.variance_s2 = kVarianceUnseen * since_s;
  if (motion.standing) {
    motion.moved_s = 0;
    motion.variance_s2 = 0;
    motion.learned = true;
  } else if (seen && model_.learned()) {
    std::optional<double> speed;
    for (std::size_t k = 0; k < options_.separations; ++k) {
      if (!compared[k].made()) continue;
      const bool clamped = static_cast<double>(compared[k].error) >= model_.error.back();
      if (clamped && speed) continue;  // says "at least" only
      const double estimate =
          curve_(static_cast<double>(compared[k].error)) / static_cast<double>(compared[k].seconds);
      speed = std::min(speed.value_or(estimate), estimate);
    }
    if (speed) {
      // The least of several estimates is below the mean speed on the average: by as much as it was so far.
      const double kept = std::exp(-since_s / options_.memory_s);
      estimated_s_ = estimated_s_ * kept + since_s * std::min(*speed, options_.max_speed);
      walked_s_ = walked_s_ * kept + since_s;
      motion.moved_s = since_s * std::min(*speed * walked_s_ / estimated_s_, options_.max_speed);
      motion.variance_s2 = kVariance * since_s;
      motion.learned = true;
    }
  }

  past_.push_back(std::move(now));
  const double keep_s =
      std::max(1.2 * options_.standing_span_s, static_cast<double>(options_.spans + 1) * span_s_);
  while (past_.size() > 1 && past_.front().time_s < time_s - keep_s) past_.pop_front();
  return motion;
}

}  // namespace vo
