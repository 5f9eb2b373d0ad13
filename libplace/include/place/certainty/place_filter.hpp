#pragma once

#include <cstddef>
#include <deque>
#include <span>
#include <vector>

namespace place {

/// A stretch of places in a row: keyframes [begin, end) of all, of one traverse without a gap in it.
struct FilterStretch {
  std::size_t begin = 0, end = 0;
  double pace = 1;  ///< of a move, see `PlaceFilter::move`
};

/// Settings of `PlaceFilter`.
struct PlaceFilterOptions {
  /// Probability of leaving the route, and of coming back anywhere, for each keyframe walked; as in
  /// `search_path` with sequences of ten.
  double leave = 0.01;
  /// How often a walker changes to the next speed ratio, for each keyframe walked.
  double change_speed = 0.02;
  std::size_t lag = 0;  ///< the most observations that `lagged` looks back by; 0: none
};

/// Where a walker is, as a belief says.
struct PlaceEstimate {
  std::size_t place = 0;   ///< the keyframe about which most is
  double mean = 0;         ///< of the places around it, keyframes
  double sd = 0;           ///< of those, keyframes
  double probability = 0;  ///< to be within the window around it
  double off_route = 0;    ///< to be off the route
  double ratio = 1;        ///< mean speed ratio there
};

/// The belief of a walker's place while walking: a histogram over the keyframes of a route and five ratios of
/// his speed to the reference's, and a state off the route (a discrete Bayes filter: Thrun, Burgard and Fox,
/// "Probabilistic Robotics", 2005, 4.1; the state off the route and uniform re-entry as in Xu, Fischer and
/// Milford's TopometricLoc of 2021). The causal form of `search_path`, which has no speed ratios as its walks
/// are sampled to one spacing.
///
/// 24 bytes for each keyframe, and for each observation in the lag.
class PlaceFilter {
 public:
  static constexpr std::size_t kRatios = 5;

  /// `stretches` cover [0, places) in order; throws `std::invalid_argument` otherwise.
  PlaceFilter(std::vector<FilterStretch> stretches, const PlaceFilterOptions& options = {});

  /// The walker moved on: on a stretch by `moved` times its pace times his ratio, in keyframes, with a
  /// variance of `variance` times the square of both. Moves add up until the next observation. Throws
  /// `std::invalid_argument` for negative values.
  void move(double moved, double variance);

  /// What a picture says: for each place the logarithm of how much more probable the picture is there than
  /// off the route. Throws `std::invalid_argument` for another number of places. O(places).
  void observe(std::span<const float> log_ratio);

  /// The belief now. `window`: keyframes to either side that are one place. O(places).
  [[nodiscard]] PlaceEstimate estimate(std::size_t window) const;

  /// The belief as of `back` observations before the last, with all that was seen since: forward-backward.
  /// Throws `std::invalid_argument` for more than there were, or than the lag. O(places * back).
  [[nodiscard]] PlaceEstimate lagged(std::size_t window, std::size_t back) const;

  [[nodiscard]] std::size_t places() const { return places_; }

  /// The ratios of a walker's speed to the reference's.
  [[nodiscard]] static double ratio(std::size_t i);

 private:
  struct Belief {
    std::vector<float> on;  // by ratio, then place
    double off = 0;
  };
  /// One observation and the move that led to it.
  struct Step {
    double moved = 0, variance = 0;
    std::vector<float> likelihood;
    Belief after;
  };

  [[nodiscard]] Belief moved_on(const Belief& before, double moved, double variance) const;
  [[nodiscard]] Belief moved_back(const Belief& after, double moved, double variance) const;
  [[nodiscard]] PlaceEstimate estimate_of(const Belief& belief, std::size_t window) const;
  [[nodiscard]] double share(double moved, double rate) const;
  void change_speeds(Belief& belief, double moved) const;

  std::vector<FilterStretch> stretches_;
  PlaceFilterOptions options_;
  std::size_t places_ = 0;
  Belief now_;
  double mean_pace_ = 1;
  double moved_ = 0, variance_ = 0;  // since the last observation
  std::deque<Step> steps_;           // the last observations, oldest first
};

}  // namespace place
