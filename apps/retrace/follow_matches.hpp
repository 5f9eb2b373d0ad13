#pragma once

#include <cstdint>
#include <vector>

#include <place/certainty/follower.hpp>
#include <place/match/match.hpp>
#include <place/route/route.hpp>

namespace retrace {

/// A followed walk as matches, as `localise` has them: one for each picture that was compared with the route,
/// with the surest answer that came, and the probability as its score. About fifteen thousand an hour.
class FollowMatches {
 public:
  /// The route must outlive this.
  explicit FollowMatches(const place::Route& route) : route_(route) {}

  /// The next position.
  void push(const place::Position& position);

  /// What the follower knows at the end (`place::Follower::finish`).
  void finish(const std::vector<place::EarlierPlace>& earlier);

  [[nodiscard]] const std::vector<place::Match>& matches() const { return matches_; }

 private:
  void revise(std::int64_t frame, const std::optional<place::FollowedPlace>& at);

  const place::Route& route_;
  std::vector<place::Match> matches_;
};

}  // namespace retrace
