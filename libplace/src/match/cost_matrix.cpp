#include "place/match/cost_matrix.hpp"

#include "match/kernels/absolute_difference.hpp"
#include "match/second_level_cache.hpp"

#include <algorithm>
#include <stdexcept>

#include <vo/base/parallel.hpp>
#include <vo/image/patch_normalisation.hpp>

namespace place {
namespace {

constexpr std::size_t kBlockReferences = 64;  // of a task

constexpr std::size_t blocks_of(std::size_t size, std::size_t count) {
  return (count + size - 1) / size;
}

/// Queries that stay in the second-level cache while references stream past: as many as fill half of it.
std::size_t band_queries(std::size_t query_bytes) {
  return std::max<std::size_t>(1, second_level_cache() / 2 / query_bytes);
}

/// Columns [first, first + width) of every image, `variants` times with the first column one further on.
vo::ImageStack columns_of(const vo::ImageStack& images, int first, int width, int variants) {
  vo::ImageStack cut =
      vo::make_image_stack(width, images.height, images.size() * static_cast<std::size_t>(variants));
  vo::parallel_for(cut.size(), [&](std::size_t i) {
    const std::span<const std::uint8_t> from = images[i / static_cast<std::size_t>(variants)];
    const int shift = first + static_cast<int>(i % static_cast<std::size_t>(variants));
    for (int y = 0; y < images.height; ++y) {
      std::copy_n(from.begin() + y * images.width + shift, width, cut[i].begin() + y * width);
    }
  });
  return cut;
}

}  // namespace

ThumbnailCosts::ThumbnailCosts(const vo::ImageStack& queries, const vo::ImageStack& references,
                               const CostOptions& options)
    : queries_(queries.size()), whole_(&queries), whole_references_(&references) {
  if (queries.width != references.width || queries.height != references.height) {
    throw std::invalid_argument("cost_matrix: query and reference descriptors differ in size");
  }
  const int shift = options.max_shift_px;
  if (shift == 0) return;
  if (shift < 0 || 2 * shift >= queries.width) {
    throw std::invalid_argument("cost_matrix: 0 <= 2 * max_shift_px < width expected");
  }
  variants_ = 2 * static_cast<std::size_t>(shift) + 1;
  const int width = queries.width - 2 * shift;
  cropped_ = columns_of(references, shift, width, 1);
  shifted_ = columns_of(queries, 0, width, 2 * shift + 1);
}

float ThumbnailCosts::unit() const {
  return 1.0F /
         (static_cast<float>(vo::kStepsPerDeviation) * static_cast<float>(reference_images().image_size()));
}

void ThumbnailCosts::compute(const Costs& block) const {
  if (block.queries == 0 || block.references == 0) return;
  const std::size_t pixels = reference_images().image_size();
  const kernels::AbsoluteDifferenceKernel kernel = kernels::absolute_difference();
  const float scale = unit();
  const std::uint8_t* query_bytes = query_images().pixels.data() + block.first_query * variants_ * pixels;
  const std::uint8_t* reference_bytes = reference_images().pixels.data() + block.first_reference * pixels;
  // Bands of about one size, a multiple of what kernels take together.
  constexpr std::size_t kTogether = 12;
  const std::size_t bands = blocks_of(band_queries(variants_ * pixels), block.queries);
  const std::size_t band = blocks_of(kTogether, blocks_of(bands, block.queries)) * kTogether;
  const std::size_t columns = blocks_of(kBlockReferences, block.references);
  vo::parallel_for(blocks_of(band, block.queries) * columns, [&](std::size_t tile) {
    const std::size_t q = tile / columns * band, r = tile % columns * kBlockReferences;
    const std::size_t tall = std::min(band, block.queries - q),
                      wide = std::min(kBlockReferences, block.references - r);
    const kernels::ByteImages query{query_bytes + q * variants_ * pixels, tall * variants_};
    const kernels::ByteImages reference{reference_bytes + r * pixels, wide};
    float* const out = block.values + q * block.stride + r;
    if (variants_ == 1) return kernel(query, reference, pixels, {scale, out, block.stride});
    std::vector<float> costs(tall * variants_ * wide);
    kernel(query, reference, pixels, {scale, costs.data(), wide});
    for (std::size_t i = 0; i < tall; ++i) {
      float* const least = out + i * block.stride;
      const float* variant = costs.data() + i * variants_ * wide;
      std::copy_n(variant, wide, least);
      for (std::size_t v = 1; v < variants_; ++v) {
        variant += wide;
        for (std::size_t j = 0; j < wide; ++j) least[j] = variant[j] < least[j] ? variant[j] : least[j];
      }
    }
  });
}

CostMatrix cost_matrix(const vo::ImageStack& queries, const vo::ImageStack& references,
                       const CostOptions& options) {
  return cost_matrix(ThumbnailCosts(queries, references, options));
}

}  // namespace place
