#include "place/trajectory/close_loops.hpp"

#include "place/match/walk_gaps.hpp"
#include "place/route/resampling.hpp"

#include <algorithm>
#include <numeric>
#include <stdexcept>

namespace place {

ClosedLoops close_loops(const vo::Walk& walk, const vo::WalkMotion& motion,
                        const LoopClosureOptions& options) {
  if (motion.trajectory.size() != walk.frames())
    throw std::invalid_argument("close_loops: a motion with a trajectory expected");
  constexpr double kSpacing_m = 0.5;
  const vo::Trajectory& odometry = motion.trajectory;
  const std::vector<double> displacement_m = vo::displacements(motion);
  ClosedLoops closed{.trajectory = odometry};
  std::vector<std::size_t> begins;  // of the parts between gaps
  for (const vo::ClockGap& gap : walk.gaps)
    if (vo::parts_walk(gap)) begins.push_back(gap.frame);
  std::vector<double> travelled_m(walk.frames());
  std::partial_sum(displacement_m.begin(), displacement_m.end(), travelled_m.begin());

  const std::vector<std::size_t> keyframes = resample(displacement_m, kSpacing_m, begins);
  vo::Trajectory nodes;
  std::vector<double> way_m;
  for (const std::size_t frame : keyframes) {
    nodes.push_back(odometry[frame]);
    way_m.push_back(travelled_m[frame]);
  }
  const auto loops = find_loops(vo::select(walk.thumbnails, keyframes), way_m, options);
  closed.loops = loops.size();
  if (loops.empty()) return closed;
  const CorrectedWalk corrected = correct_drift(nodes, {}, loops, {}, gaps_at(keyframes, walk.time_s));
  if (corrected.status != DriftStatus::kCorrected) return closed;
  closed.believed = static_cast<std::size_t>(
      std::ranges::count_if(corrected.loop_weight, [](double weight) { return weight >= 0.5; }));
  closed.trajectory = corrected_between(odometry, keyframes, corrected);
  return closed;
}

}  // namespace place
