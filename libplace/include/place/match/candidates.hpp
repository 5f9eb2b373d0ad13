#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include <vo/image/image_stack.hpp>

namespace place {

/// Settings of `candidates`.
struct CandidateOptions {
  int pool_px = 4;      ///< pixels are summed over squares of this side first
  int dimensions = 16;  ///< of the compact descriptors: principal components
  int sample = 512;     ///< references, evenly spaced, that the components are learned from
  double slack = 2;     ///< a reference may pass as nearest if it is at most this share further away
  int shortlist = 16;   ///< nearest references of each query keyframe
  int run = 32;         ///< query keyframes that vote together for stretches of the reference
  int stretches = 6;    ///< of the reference that each run keeps
  int margin = 64;      ///< keyframes kept on either side of a stretch; at least half a line
};

/// With more keyframes than this, a walk is brought to another's scale by its candidates alone
/// (`sample_walk`).
inline constexpr std::size_t kMostForScale = 50'000;

/// The references that a walk may be on, for a reference too large to compare with as a whole: keyframe
/// indices, increasing, in stretches.
///
/// Descriptors are pooled and reduced to principal components, learned from a sample, and each query's
/// approximate nearest references are found in FLANN's k-d tree. Successive queries vote for stretches of the
/// reference, each neighbour for the place it suggests if both walks continue at about the same pace; the
/// stretches with most votes are kept. The sample is kept too, so that contrast enhancement sees the
/// statistics of the whole reference.
///
/// `queries`, `references`: descriptors of one size, else throws `std::invalid_argument`. With fewer
/// references than the sample size, all are candidates. O(references * (pixels + pixels / pool_px^2 *
/// dimensions + log references)); 8 * dimensions bytes for each reference and about 20 for its tree node.
std::vector<std::size_t> candidates(const vo::ImageStack& queries, const vo::ImageStack& references,
                                    const CandidateOptions& options = {});

/// The same in parts, for references that are not in memory as a whole: components learned from the sample,
/// each part projected by itself, and then the search among all projections.
class CandidateFinder {
 public:
  /// `sample`: the references at `candidate_sample`, in order. Throws `std::invalid_argument` for options out
  /// of range. O(sample * pooled pixels^2 + pooled pixels^3).
  CandidateFinder(const vo::ImageStack& sample, const CandidateOptions& options);
  ~CandidateFinder();
  CandidateFinder(CandidateFinder&&) noexcept;
  CandidateFinder& operator=(CandidateFinder&&) noexcept;

  /// Values that an image is reduced to.
  [[nodiscard]] std::size_t dimensions() const;
  /// The images' projections, `dimensions()` values each, one after the other. O(images * pixels).
  [[nodiscard]] std::vector<float> project(const vo::ImageStack& images) const;
  /// The candidates among `references`, the projections of all, in order. Cost as for `candidates`.
  [[nodiscard]] std::vector<std::size_t> find(const vo::ImageStack& queries, std::vector<float> references,
                                              const CandidateOptions& options) const;

 private:
  struct Components;
  std::unique_ptr<const Components> components_;
};

/// The references, evenly spaced, that components are learned from; all of few.
std::vector<std::size_t> candidate_sample(std::size_t references, const CandidateOptions& options);

/// True if there are so few references that all are candidates.
bool all_are_candidates(std::size_t references, const CandidateOptions& options);

}  // namespace place
