#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <vo/image/image_stack.hpp>

namespace place {

/// A value for every (query, reference) pair of keyframes. One row per query; the reference index runs along
/// the row, contiguous in memory. Lower means more alike.
struct CostMatrix {
  std::size_t queries = 0;
  std::size_t references = 0;
  std::vector<float> values;

  [[nodiscard]] std::span<const float> row(std::size_t query) const {
    return std::span(values).subspan(query * references, references);
  }
  [[nodiscard]] std::span<float> row(std::size_t query) {
    return std::span(values).subspan(query * references, references);
  }
  [[nodiscard]] float at(std::size_t query, std::size_t reference) const {
    return values[query * references + reference];
  }
};

/// A matrix of zeros.
CostMatrix make_cost_matrix(std::size_t queries, std::size_t references);

/// Mean absolute difference of patch-normalised descriptors, in standard deviations of a patch (SSS 3.1
/// and 3.4; SeqSLAM's image difference). Sums are exact integers, so every instruction set gives the same
/// bytes.
///
/// Both stacks: bytes of `vo::patch_normalise`, of the same width and height. Throws `std::invalid_argument`
/// if the sizes differ. O(queries * references * pixels), in parallel over queries.
CostMatrix cost_matrix(const vo::ImageStack& queries, const vo::ImageStack& references);

}  // namespace place
