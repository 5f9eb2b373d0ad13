#include "vo/motion/motion_evidence.hpp"

#include <cstddef>
#include <stdexcept>

namespace vo {

void check(const MotionEvidence& evidence) {
  const std::size_t frames = evidence.time_s.size();
  const bool track = evidence.track == nullptr || evidence.track->size() == frames;
  const bool errors = evidence.errors == nullptr ||
                      (evidence.errors->frames() == frames && evidence.errors_known.size() == frames);
  const bool standing = evidence.standing.empty() || evidence.standing.size() == frames;
  const bool steps = evidence.steps_m.empty() ||
                     (evidence.steps_m.size() == frames && evidence.steps_known.size() == frames);
  if (!(track && errors && standing && steps))
    throw std::invalid_argument("motion evidence: one value per frame of each source expected");
}

}  // namespace vo
