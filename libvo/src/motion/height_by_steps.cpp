#include "vo/motion/height_by_steps.hpp"

#include "vo/visual_odometry/ground_height.hpp"

#include <algorithm>
#include <cstddef>
#include <map>
#include <stdexcept>
#include <vector>

namespace vo {

std::optional<double> height_by_steps_m(const DisplacementTrack& track, std::span<const double> steps_m) {
  if (steps_m.size() != track.size())
    throw std::invalid_argument("height_by_steps_m: one displacement per frame expected");
  struct Segment {
    double walked_m = 0, passed = 0;
    std::vector<double> heights;
  };
  std::map<int, Segment> segments;
  for (std::size_t i = 0; i < track.size() && !track.heights.empty(); ++i) {
    if (!track.frames[i].valid || !(steps_m[i] > 0)) continue;
    Segment& segment = segments[track.frames[i].segment];
    segment.walked_m += steps_m[i];
    segment.passed += track.frames[i].displacement;
    segment.heights.insert(segment.heights.end(), track.heights[i].begin(), track.heights[i].end());
  }
  const auto longest =
      std::ranges::max_element(segments, {}, [](const auto& numbered) { return numbered.second.walked_m; });
  if (longest == segments.end() || !(longest->second.passed > 0)) return std::nullopt;
  std::optional<double> height = ground_height(longest->second.heights);
  if (height) *height *= longest->second.walked_m / longest->second.passed;
  return height;
}

}  // namespace vo
