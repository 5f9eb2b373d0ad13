#pragma once

#include <cstddef>
#include <vector>

#include <vo/image/image_stack.hpp>

namespace place {

/// Settings of `candidates`.
struct CandidateOptions {
  int pool_px = 4;      ///< pixels are summed over squares of this side first
  int dimensions = 16;  ///< of the compact descriptors: principal components
  int sample = 512;     ///< references, evenly spaced, that the components are learned from
  double slack = 2;     ///< a reference this share further away than the true nearest may be taken for it
  int shortlist = 16;   ///< nearest references of each query keyframe
  int run = 32;         ///< query keyframes that look for a stretch of the reference together
  int stretches = 6;    ///< of the reference that each run keeps
  int margin = 64;      ///< keyframes kept on either side of a stretch; no less than half a line
};

/// The references that a walk may be on, for a reference too large to be compared with as a whole: keyframe
/// indices, increasing, in stretches.
///
/// Descriptors are pooled and reduced to principal components, learned from a sample, and each query's
/// nearest references found, near enough, in FLANN's k-d tree. Queries that follow each other vote for
/// stretches of the reference, each neighbour for the place that it makes probable where both walks go on at
/// about the same pace; the stretches with most votes are kept. The sample is kept too, so that the
/// statistics of contrast enhancement are those of the reference at large.
///
/// `queries`, `references`: descriptors of one size; throws `std::invalid_argument` if they are not. With
/// fewer references than the sample has, all are candidates. O(references * (pixels + pixels / pool_px^2 *
/// dimensions + log references)); 8 * dimensions bytes for each reference and some 20 for its place in the
/// tree.
std::vector<std::size_t> candidates(const vo::ImageStack& queries, const vo::ImageStack& references,
                                    const CandidateOptions& options = {});

}  // namespace place
