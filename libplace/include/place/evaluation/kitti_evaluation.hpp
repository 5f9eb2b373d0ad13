#pragma once

#include "vo/base/pose3.hpp"

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace place {

/// Settings of `evaluate_kitti`.
struct KittiEvaluationOptions {
  std::vector<double> lengths_m{100, 200, 300, 400, 500, 600, 700, 800};  ///< of the stretches
  std::size_t every = 10;                                                 ///< frames between their starts
};

/// Mean errors over stretches.
struct KittiErrors {
  double length_m = 0;         ///< of each stretch; 0 for all lengths together
  std::size_t stretches = 0;   ///< if 0, the errors are 0
  double translation_pct = 0;  ///< per cent of the length
  double rotation_deg_per_m = 0;
};

struct KittiEvaluation {
  std::vector<KittiErrors> by_length;  ///< one for each length
  KittiErrors all;
  std::size_t unknown = 0;  ///< stretches left out because the estimate has no pose at one of their ends
};

/// The odometry benchmark of KITTI (Geiger, Lenz and Urtasun 2012; its development kit): from every tenth
/// frame, the estimated motion over the next 100, 200, ... 800 m is compared with the true one, and the
/// errors of position and orientation are divided by the length. A stretch ends at the first frame beyond its
/// length.
///
/// `truth`, `estimate`: one for each frame, world_from_camera, in metres; their worlds may differ. Throws
/// `std::invalid_argument` for other numbers of poses, or lengths not above 0. O(frames * lengths).
KittiEvaluation evaluate_kitti(std::span<const vo::Pose3> truth,
                               std::span<const std::optional<vo::Pose3>> estimate,
                               const KittiEvaluationOptions& options = {});

/// Metres in a unit of the estimate, from both path lengths over the first `length_m` metres of the truth,
/// starting at the estimate's first pose. None if the estimate lacks poses there or does not move.
std::optional<double> metres_per_unit(std::span<const vo::Pose3> truth,
                                      std::span<const std::optional<vo::Pose3>> estimate, double length_m);

}  // namespace place
