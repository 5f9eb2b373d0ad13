#pragma once

#include "place/trajectory/drift_correction.hpp"

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

namespace place {

/// Settings of `FixedLagCorrector`.
struct FixedLagOptions {
  DriftCorrectionOptions drift;
  std::size_t lag = 60;  ///< nodes that may still change, 2 or more; half a minute of walking
};

/// `correct_drift` for a walk in progress: the same graph over the last nodes only. Older nodes and their
/// fixes remain as a prior on the oldest node in it (their marginal, a 6 x 6 Schur complement). All nodes are
/// kept until matches agree on where the walk is.
class FixedLagCorrector {
 public:
  /// Throws `std::invalid_argument` for options that are not valid.
  explicit FixedLagCorrector(const FixedLagOptions& options = {});
  ~FixedLagCorrector();
  FixedLagCorrector(FixedLagCorrector&&) noexcept;
  FixedLagCorrector& operator=(FixedLagCorrector&&) noexcept;

  /// Takes the next node of the walk and, if it was recognised, its fix, whose `node` is ignored. Returns the
  /// poses that are now final: none, one, or a walk's whole beginning once its place is known. Solves if
  /// there is a fix: O(lag), or of all nodes so far until the walk is placed.
  std::vector<UncertainPose> push(const vo::TimedPose& odometry, const std::optional<PoseFix>& fix);

  /// Where the walker is now; none before matches agree. O(lag).
  [[nodiscard]] std::optional<UncertainPose> latest() const;

  /// The poses not yet returned; none if matches never agreed. Nothing else may be called afterwards.
  std::vector<UncertainPose> finish();

 private:
  struct Window;
  std::unique_ptr<Window> window_;
};

}  // namespace place
