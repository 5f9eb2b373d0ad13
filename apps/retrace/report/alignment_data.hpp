#pragma once

#include <optional>

#include <nlohmann/json_fwd.hpp>

#include <vo/odometry.hpp>

namespace retrace {

/// What the figures of alignment error need of a walk (`put_alignment`), as JSON of at most 0.2 MB: the mean
/// error over each span and the learned relation, the course of the error with the frames left out, and, as
/// pictures, the error over frames and spans and the difference of each pixel. An empty object for a walk
/// without motion to learn from.
///
/// `motion`: of the walk, or none to compute it with `options`, as for a walk whose motion is steps alone.
nlohmann::ordered_json alignment_data(const vo::Walk& walk, const std::optional<vo::VisualMotion>& motion,
                                      const vo::VisualMotionOptions& options);

}  // namespace retrace
