#pragma once

#include "support/synthetic_walk.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <place/route/walk_sampling.hpp>

/// Walks along a wall whose places are known, as routes and as queries.
namespace test_support {

inline constexpr int kWallPx = 600;

/// A walk and where its frames truly are.
struct KnownWalk {
  std::vector<double> place_px;
  vo::Walk walk;
};

inline KnownWalk known_walk(const Wall& wall, std::vector<double> place_px) {
  vo::Walk walk = wall.walk(place_px);
  return {std::move(place_px), std::move(walk)};
}

/// A steady walk along the whole wall.
inline KnownWalk steady_walk(const Wall& wall, double speed_px, double start_px = 0,
                             double end_px = kWallPx) {
  const auto frames = static_cast<std::size_t>((end_px - start_px) / speed_px);
  return known_walk(wall, places(start_px, std::vector<double>(frames, speed_px)));
}

/// Distances along the wall at a tenth of a metre per pixel, and poses to match.
inline place::Survey survey_of(const KnownWalk& known) {
  place::Survey survey{.source = "truth.csv", .pose = {}, .distance_m = {}};
  for (const double place_px : known.place_px) {
    survey.distance_m.emplace_back(place_px / 10);
    survey.pose.emplace_back(vo::Pose2{place_px / 10, 0, 0});
  }
  return survey;
}

inline constexpr double kSamplingN = 6;  ///< of SSS Eq. 4

/// Adds a walk to a route, the first one giving the sampling unit.
inline void add_traverse(place::Route& route, const std::string& name, const KnownWalk& known,
                         place::WalkSamplingOptions options = {}, bool surveyed = true) {
  options.n = kSamplingN;
  route.settings.sampling_n = kSamplingN;
  const auto sampled = place::sample_walk(known.walk, options, &route);
  if (route.traverses.empty()) {
    route.unit = sampled.unit;
    route.metric = sampled.metric;
    route.learned = sampled.learned;
  }
  route.traverses.push_back(place::make_traverse(name, known.walk, sampled,
                                                 surveyed ? std::optional(survey_of(known)) : std::nullopt));
}

inline place::SampledWalk sample_query(const KnownWalk& known, const place::Route& route) {
  place::WalkSamplingOptions options;
  options.n = kSamplingN;
  return place::sample_walk(known.walk, options, &route);
}

/// Mean pixels between neighbouring keyframes of a traverse.
inline double spacing_px(const place::Traverse& traverse) {
  return 10 * (*traverse.keyframes.back().distance_m - *traverse.keyframes.front().distance_m) /
         static_cast<double>(traverse.keyframes.size() - 1);
}

}  // namespace test_support
