#include "place/certainty/follower.hpp"

#include "certainty/live_costs.hpp"
#include "place/certainty/place_filter.hpp"
#include "place/resolve.hpp"
#include "place/stage_options.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <stdexcept>
#include <utility>
#include <vector>

#include <vo/base/error.hpp>
#include <vo/base/median.hpp>
#include <vo/image/patch_normalisation.hpp>
#include <vo/image/thumbnail.hpp>
#include <vo/motion/motion_follower.hpp>

namespace place {
namespace {

constexpr double kBetweenObservations = 0.5;  // keyframes
constexpr std::size_t kWindow = 5;            // keyframes to either side that are one place, as in search
constexpr double kFound = 0.9;                // probability at which a walker who was not is on the route
constexpr double kLost = 0.4;                 // below which one who was is not
constexpr double kLeft = 0.5;           // of being off the route, at which one who was on it has left it
constexpr double kLeastContrast = 0.2;  // share of the usual below which a picture shows nothing
// How much more probable a place is for each deviation that its cost is lower. `search_path` takes 0.5 for
// pictures a keyframe apart that it sees all of.
constexpr float kSteepness = 0.8F;
// The cost at which a place is as probable as being off the route, in deviations below the mean. Once this
// walk's usual cost on the route is known, at least this share of it, so that a street that looks like the
// route is not taken for it. Chosen, as the steepness, on 8 drawn routes and 16 pairs of a walk and a route
// that it is not on; the share on two walks with a detour; reported on others (tests/RESULTS.md).
constexpr double kLeastEven = 1.5, kEvenShare = 0.55;
// The filter spreads every move over at least half a keyframe, so that small moves reach the next one; its
// deviation is therefore too large. Errors are this share of it: 90 % of them were within 1.64 times the
// result on 16 drawn walks; reported on others (tests/RESULTS.md).
constexpr double kErrorShare = 0.75;
constexpr double kBetweenKeyframes = 0.3;  // standard deviation of a place that a keyframe stands for

/// Keyframes a second while the walker moved.
double pace_of(const Traverse& traverse) {
  std::vector<double> paces;
  for (std::size_t k = 1; k < traverse.keyframes.size(); ++k) {
    const double s = traverse.keyframes[k].time_s - traverse.keyframes[k - 1].time_s;
    if (s > 0 && !traverse.keyframes[k].after_gap) paces.push_back(1 / s);
  }
  return paces.empty() ? 1 : vo::median(paces);
}

Settings resolved_for(const Route& route, Settings given) {
  if (route.traverses.empty())
    throw vo::Error("the route", "has no traverse", "a walk that was built into it");
  if (route.settings.motion == "file" && !given.motion) {  // a track is for a walk that is over
    given.motion = "none";
    given.every = 1;
  }
  return resolve(given, {.purpose = Purpose::kLocalise, .route = &route.settings, .drop_ineffective = true});
}

std::optional<double> between(const std::optional<double>& a, const std::optional<double>& b, double t) {
  if (!a) return {};
  return b ? std::lerp(*a, *b, t) : *a;
}

}  // namespace

std::string name_of(FollowState state) {
  switch (state) {
    case FollowState::kSearching:
      return "searching";
    case FollowState::kOnRoute:
      return "on_route";
    case FollowState::kOffRoute:
      return "off_route";
  }
  return "";
}

namespace {

double checked_lag_s(double lag_s) {
  constexpr double kLongest_s = 60;
  if (!(lag_s >= 0 && lag_s <= kLongest_s))
    throw std::invalid_argument("Follower: a lag of 0 to 60 s expected");
  return lag_s;
}

}  // namespace

class Follower::Implementation {
 public:
  Implementation(const Route& route, const Settings& settings, const FollowerOptions& options)
      : route_(route),
        settings_(resolved_for(route, settings)),
        stages_(stage_options(settings_)),
        lag_s_(checked_lag_s(options.lag_s)),
        costs_(route, stages_),
        stretches_(stretches()),
        filter_(stretches_, {.lag = most_observations_back()}) {
    stages_.walk.frames.colour_width_px = stages_.walk.colour_width_px;
    stages_.walk.frames.look_ahead = false;  // an answer depends on no later picture
  }

  Position push(const vo::Frame& frame) {
    const vo::ThumbnailOptions& size = stages_.walk.thumbnail;
    vo::ImageStack thumbnail = vo::make_image_stack(size.width, size.height, 1);
    vo::make_thumbnail(frame.image, size, thumbnail[0]);
    const vo::PatchNormalisationOptions& patch = stages_.matching.patch;
    const bool seen = shows_something(vo::patch_contrast(thumbnail, patch.patch_px).front());
    const vo::FollowedMotion motion =
        motion_.push(vo::patch_normalise(thumbnail, patch)[0], frame.time_s, seen);
    filter_.move(motion.moved_s, motion.variance_s2);
    moved_ += motion.moved_s * pace_;
    const bool described = seen && (first_ || moved_ >= kBetweenObservations);
    if (described) {
      observe(frame, thumbnail);
      first_ = false;
      moved_ = 0;
      look_back(frame);
    }
    Position now = position(frame);
    now.described = described;
    return now;
  }

  [[nodiscard]] std::vector<EarlierPlace> finish() const {
    std::vector<EarlierPlace> earlier;
    for (std::size_t i = 0; i < observed_.size(); ++i) {
      const PlaceEstimate then = filter_.lagged(kWindow, observed_.size() - 1 - i);
      EarlierPlace& one = earlier.emplace_back(EarlierPlace{.frame = observed_[i].frame, .place = {}});
      if (then.probability >= kLeft) one.place = place_of(then);
    }
    return earlier;
  }

  [[nodiscard]] const Settings& settings() const { return settings_; }

  [[nodiscard]] const vo::FrameSourceOptions& frame_source() const { return stages_.walk.frames; }

 private:
  /// The traverses one after another, cut at their gaps.
  std::vector<FilterStretch> stretches() {
    std::vector<FilterStretch> all;
    std::size_t begin = 0;
    double paces = 0;
    for (const Traverse& traverse : route_.traverses) {
      const double pace = pace_of(traverse);
      paces += pace / static_cast<double>(route_.traverses.size());
      begins_.push_back(begin);
      std::vector<std::size_t> cuts = gaps_of(traverse);
      cuts.push_back(traverse.keyframes.size());
      std::size_t from = begin;
      for (const std::size_t cut : cuts) {
        if (begin + cut > from) all.push_back({from, begin + cut, pace});
        from = begin + cut;
      }
      begin += traverse.keyframes.size();
    }
    pace_ = paces;
    return all;
  }

  /// Observations in the lag of a walker who is three times as fast as the reference.
  [[nodiscard]] std::size_t most_observations_back() const {
    constexpr double kFastest = 3;
    return static_cast<std::size_t>(std::ceil(kFastest * lag_s_ * pace_ / kBetweenObservations));
  }

  /// The answer of the last observation that is `lag_s` old, or of the first.
  void look_back(const vo::Frame& frame) {
    if (lag_s_ == 0) return;
    observed_.push_back({frame.index, frame.time_s});
    if (observed_.size() > most_observations_back() + 1) observed_.pop_front();
    while (observed_.size() > 1 && observed_[1].time_s <= frame.time_s - lag_s_) observed_.pop_front();
    lagged_ = filter_.lagged(kWindow, observed_.size() - 1);
  }

  bool shows_something(double contrast) {
    const bool seen = usual_contrast_ == 0 || contrast >= kLeastContrast * usual_contrast_;
    constexpr double kNew = 0.02;  // an average over about fifty frames
    if (seen) usual_contrast_ = usual_contrast_ == 0 ? contrast : std::lerp(usual_contrast_, contrast, kNew);
    return seen && contrast > 0;
  }

  void observe(const vo::Frame& frame, const vo::ImageStack& thumbnail) {
    const std::vector<float> costs = costs_.against(frame, thumbnail);
    constexpr float kFurthest = 6;  // as `search_path`
    const auto even = static_cast<float>(std::max(kLeastEven, -kEvenShare * usual_cost_));
    const auto weight = static_cast<float>(first_ ? 1 : std::min(1.0, moved_));
    std::vector<float> log_ratio(costs.size());
    for (std::size_t r = 0; r < costs.size(); ++r)
      log_ratio[r] = -kSteepness * weight * (std::clamp(costs[r], -kFurthest, kFurthest) + even);
    filter_.observe(log_ratio);
    const PlaceEstimate now = filter_.estimate(kWindow);
    if (now.probability < kFound) return;
    constexpr double kNew = 0.05;  // an average over about twenty pictures
    usual_cost_ = std::lerp(usual_cost_, static_cast<double>(costs[now.place]), kNew);
  }

  Position position(const vo::Frame& frame) {
    Position position{.frame = frame.index, .time_s = frame.time_s};
    if (first_) return position;
    const PlaceEstimate now = filter_.estimate(kWindow);
    position.off_route = now.off_route;
    if (now.probability >= kFound) {
      state_ = FollowState::kOnRoute;
    } else if (state_ == FollowState::kOnRoute && now.off_route >= kLeft) {
      state_ = FollowState::kOffRoute;
    } else if (state_ == FollowState::kOnRoute && now.probability < kLost) {
      state_ = FollowState::kSearching;
    }
    position.state = state_;
    if (state_ == FollowState::kOnRoute) position.place = place_of(now);
    if (!lagged_) return position;
    position.lag_frame = observed_.front().frame;
    if (lagged_->probability >= kLeft) position.lag_place = place_of(*lagged_);
    return position;
  }

  [[nodiscard]] FollowedPlace place_of(const PlaceEstimate& estimate) const {
    const auto above = std::ranges::upper_bound(begins_, estimate.place);
    const auto index = static_cast<std::size_t>(above - begins_.begin()) - 1;
    const Traverse& traverse = route_.traverses[index];
    const double last = static_cast<double>(traverse.keyframes.size() - 1);
    const double at = std::clamp(estimate.mean - static_cast<double>(begins_[index]), 0.0, last);
    const auto low = static_cast<std::size_t>(at), high = std::min(low + 1, traverse.keyframes.size() - 1);
    const double t = at - static_cast<double>(low);
    const Keyframe &a = traverse.keyframes[low], &b = traverse.keyframes[high];
    const Keyframe& nearest = t < 0.5 ? a : b;
    FollowedPlace place{.traverse = traverse.name,
                        .keyframe = t < 0.5 ? low : high,
                        .reference_frame = nearest.frame,
                        .distance_m = between(a.distance_m, b.distance_m, t),
                        .sd_m = {},
                        .sd_keyframes = std::hypot(kErrorShare * estimate.sd, kBetweenKeyframes),
                        .probability = std::min(1.0, estimate.probability),
                        .pose = nearest.pose};
    const Keyframe &first = traverse.keyframes.front(), &end = traverse.keyframes.back();
    if (first.distance_m && end.distance_m && last > 0)
      place.sd_m = place.sd_keyframes * std::abs(*end.distance_m - *first.distance_m) / last;
    if (a.pose && b.pose) {
      place.pose =
          vo::Pose2{std::lerp(a.pose->x_m, b.pose->x_m, t), std::lerp(a.pose->y_m, b.pose->y_m, t),
                    vo::wrap_angle_rad(a.pose->heading_rad +
                                       t * vo::wrap_angle_rad(b.pose->heading_rad - a.pose->heading_rad))};
    }
    return place;
  }

  struct Observed {
    std::int64_t frame = 0;
    double time_s = 0;
  };

  const Route& route_;
  Settings settings_;
  StageOptions stages_;
  double lag_s_ = 0;
  std::vector<std::size_t> begins_;  // of the traverses among all places
  double pace_ = 1;                  // keyframes a second
  LiveCosts costs_;
  std::vector<FilterStretch> stretches_;
  PlaceFilter filter_;
  vo::MotionFollower motion_;
  bool first_ = true;
  double moved_ = 0;  // keyframes since the last observation
  double usual_contrast_ = 0;
  double usual_cost_ = 0;  // at the walker's place, while it is known
  FollowState state_ = FollowState::kSearching;
  std::deque<Observed> observed_;  // from the one that the lag reaches back to
  std::optional<PlaceEstimate> lagged_;
};

Follower::Follower(const Route& route, const Settings& settings, const FollowerOptions& options)
    : implementation_(std::make_unique<Implementation>(route, settings, options)) {}
Follower::~Follower() = default;
Follower::Follower(Follower&&) noexcept = default;
Follower& Follower::operator=(Follower&&) noexcept = default;

Position Follower::push(const vo::Frame& frame) {
  return implementation_->push(frame);
}

std::vector<EarlierPlace> Follower::finish() const {
  return implementation_->finish();
}

const Settings& Follower::settings() const {
  return implementation_->settings();
}

const vo::FrameSourceOptions& Follower::frame_source() const {
  return implementation_->frame_source();
}

}  // namespace place
