#include "place/cost_matrix.hpp"

#include "kernels/absolute_difference.hpp"

#include <stdexcept>

#include <vo/base/parallel.hpp>
#include <vo/image/patch_normalisation.hpp>

namespace place {

CostMatrix make_cost_matrix(std::size_t queries, std::size_t references) {
  return {.queries = queries, .references = references, .values = std::vector<float>(queries * references)};
}

CostMatrix cost_matrix(const vo::ImageStack& queries, const vo::ImageStack& references) {
  if (queries.width != references.width || queries.height != references.height) {
    throw std::invalid_argument("cost_matrix: query and reference descriptors differ in size");
  }
  CostMatrix matrix = make_cost_matrix(queries.size(), references.size());
  const std::size_t pixels = queries.image_size();
  const float scale = 1.0F / (static_cast<float>(vo::kStepsPerDeviation) * static_cast<float>(pixels));
  const kernels::AbsoluteDifferenceKernel kernel = kernels::absolute_difference();

  // Blocks of references stay in the second-level cache while a band of queries passes over them.
  constexpr std::size_t kBandQueries = 16;
  constexpr std::size_t kBlockReferences = 256;
  const std::size_t bands = (matrix.queries + kBandQueries - 1) / kBandQueries;
  vo::parallel_for(bands, [&](std::size_t band) {
    std::vector<std::uint32_t> sums(kBlockReferences);
    const std::size_t end = std::min(matrix.queries, (band + 1) * kBandQueries);
    for (std::size_t r = 0; r < matrix.references; r += kBlockReferences) {
      const std::size_t count = std::min(kBlockReferences, matrix.references - r);
      for (std::size_t q = band * kBandQueries; q < end; ++q) {
        kernel(queries[q].data(), references[r].data(), count, pixels, sums.data());
        const std::span<float> row = matrix.row(q).subspan(r, count);
        for (std::size_t j = 0; j < count; ++j) row[j] = static_cast<float>(sums[j]) * scale;
      }
    }
  });
  return matrix;
}

}  // namespace place
