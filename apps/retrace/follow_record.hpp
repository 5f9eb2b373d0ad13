#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <place/certainty/follower.hpp>
#include <place/route/route.hpp>
#include <vo/io/frame_source.hpp>

namespace retrace {

/// Moments of a followed walk, with a small picture of each, for the page that plays them. It does not grow
/// with the walk: when 600 are kept, every second one is dropped, and from then on half as many are taken.
class FollowRecord {
 public:
  /// Keeps the moment if it is half a second (or what that has become) after the last one kept.
  void push(const place::Position& position, const vo::Frame& frame);

  /// The page: one HTML file with everything in it. `walk`: what was followed, for the title.
  [[nodiscard]] std::string page(const place::Route& route, const std::string& walk) const;

  struct Moment {
    place::Position position;
    std::vector<std::uint8_t> jpeg;  // 160 px wide
  };
  [[nodiscard]] const std::vector<Moment>& moments() const { return moments_; }

 private:
  std::vector<Moment> moments_;
  double interval_s_ = 0.5;
};

}  // namespace retrace
