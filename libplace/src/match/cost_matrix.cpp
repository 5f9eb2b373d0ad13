#include "place/match/cost_matrix.hpp"

#include "kernels/absolute_difference.hpp"
#include "match/second_level_cache.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <span>
#include <stdexcept>
#include <vector>

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

/// Each image column after column, so that neighbouring columns of it are bytes in a row.
vo::ImageStack turned(const vo::ImageStackView& images) {
  vo::ImageStack out = vo::make_image_stack(images.height, images.width, images.size());
  const auto width = static_cast<std::size_t>(images.width), height = static_cast<std::size_t>(images.height);
  vo::parallel_for(images.size(), [&](std::size_t i) {
    const std::span<const std::uint8_t> from = images[i];
    const std::span<std::uint8_t> to = out[i];
    for (std::size_t y = 0; y < height; ++y) {
      for (std::size_t x = 0; x < width; ++x) to[x * height + y] = from[y * width + x];
    }
  });
  return out;
}

/// The mean sum of absolute differences between different images, among up to 64 evenly spaced ones.
double mean_difference(const vo::ImageStackView& images) {
  constexpr std::size_t kSample = 64;
  const std::size_t count = std::min(kSample, images.size()), size = images.image_size();
  if (count < 2) return 0;
  vo::ImageStack sample = vo::make_image_stack(images.width, images.height, count);
  for (std::size_t i = 0; i < count; ++i)
    std::ranges::copy(images[i * images.size() / count], sample[i].begin());
  std::vector<float> sums(count * count);
  const kernels::ByteImages all{sample.pixels.data(), count};
  kernels::absolute_difference()(all, all, {size, size}, {1, sums.data(), count});
  double sum = 0;  // an image adds 0 with itself
  for (const float of_pair : sums) sum += static_cast<double>(of_pair);
  return sum / static_cast<double>(count * (count - 1));
}

}  // namespace

ThumbnailCosts::ThumbnailCosts(const vo::ImageStackView& queries, const vo::ImageStackView& references,
                               const CostOptions& options)
    : queries_(queries), references_(references) {
  if (queries.width != references.width || queries.height != references.height) {
    throw std::invalid_argument("cost_matrix: query and reference descriptors differ in size");
  }
  const int most = options.max_shift_px;
  if (most == 0) return;
  if (most < 0 || most >= queries.width) {
    throw std::invalid_argument("cost_matrix: 0 <= max_shift_px < width expected");
  }
  turned_queries_ = turned(queries);
  turned_references_ = turned(references);
  const double centre = mean_difference(references);
  for (int shift = -most; shift <= most; ++shift) {
    const int columns = queries.width - std::abs(shift);
    const double root = std::sqrt(static_cast<double>(columns) / queries.width);
    shifts_.push_back({.query_column = static_cast<std::size_t>(std::max(0, shift)),
                       .reference_column = static_cast<std::size_t>(std::max(0, -shift)),
                       .columns = static_cast<std::size_t>(columns),
                       .factor = static_cast<float>(1 / root),
                       .term = static_cast<float>(centre * (1 - root))});
  }
}

float ThumbnailCosts::unit() const {
  return 1.0F / (static_cast<float>(vo::kStepsPerDeviation) * static_cast<float>(references_.image_size()));
}

void ThumbnailCosts::compute(const Costs& block) const {
  if (block.queries == 0 || block.references == 0) return;
  const std::size_t pixels = references_.image_size(), height = static_cast<std::size_t>(references_.height);
  const kernels::AbsoluteDifferenceKernel kernel = kernels::absolute_difference();
  const float scale = unit();
  const vo::ImageStackView queries = shifts_.empty() ? queries_ : turned_queries_,
                           references = shifts_.empty() ? references_ : turned_references_;
  const std::uint8_t* query_bytes = queries.pixels.data() + block.first_query * pixels;
  const std::uint8_t* reference_bytes = references.pixels.data() + block.first_reference * pixels;
  // Bands of similar size, a multiple of what kernels process together.
  constexpr std::size_t kTogether = 12;
  const std::size_t bands = blocks_of(band_queries(pixels), block.queries);
  const std::size_t band = blocks_of(kTogether, blocks_of(bands, block.queries)) * kTogether;
  const std::size_t columns = blocks_of(kBlockReferences, block.references);
  vo::parallel_for(blocks_of(band, block.queries) * columns, [&](std::size_t tile) {
    const std::size_t q = tile / columns * band, r = tile % columns * kBlockReferences;
    const std::size_t tall = std::min(band, block.queries - q),
                      wide = std::min(kBlockReferences, block.references - r);
    float* const out = block.values + q * block.stride + r;
    if (shifts_.empty()) {
      kernel({query_bytes + q * pixels, tall}, {reference_bytes + r * pixels, wide}, {pixels, pixels},
             {scale, out, block.stride});
      return;
    }
    std::vector<float> sums(tall * wide), least(tall * wide, std::numeric_limits<float>::max());
    for (const Shift& shift : shifts_) {
      kernel({query_bytes + q * pixels + shift.query_column * height, tall},
             {reference_bytes + r * pixels + shift.reference_column * height, wide},
             {shift.columns * height, pixels}, {1, sums.data(), wide});
      for (std::size_t i = 0; i < sums.size(); ++i) {
        const float cost = sums[i] * shift.factor + shift.term;
        least[i] = cost < least[i] ? cost : least[i];
      }
    }
    for (std::size_t i = 0; i < tall; ++i) {
      for (std::size_t j = 0; j < wide; ++j) {
        const auto whole = static_cast<std::int32_t>(least[i * wide + j] + 0.5F);
        out[i * block.stride + j] = static_cast<float>(whole) * scale;
      }
    }
  });
}

CostMatrix cost_matrix(const vo::ImageStackView& queries, const vo::ImageStackView& references,
                       const CostOptions& options) {
  return cost_matrix(ThumbnailCosts(queries, references, options));
}

}  // namespace place
