#include "place/describe/hog.hpp"

#include "describe/standardised_columns.hpp"
#include "place/describe/gradient_cells.hpp"
#include "place/describe/quantise.hpp"
#include "place/describe/standardise.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include <fmt/format.h>

#include <vo/base/error.hpp>
#include <vo/base/parallel.hpp>

namespace place {
namespace {

constexpr CellGrid kHogGrid{.rows = 8, .columns = 16, .cell_px = 8, .directions = 12};
constexpr int kHogColumns = kHogGrid.columns - 1, kHogRows = kHogGrid.rows - 1,
              kBlock = 4 * kHogGrid.directions;

void normalise_cells(std::span<float> block) {
  const auto squares = [&] { return std::inner_product(block.begin(), block.end(), block.begin(), 0.0F); };
  const float first = std::sqrt(squares() + 100);  // about the noise of one or two grey levels
  for (float& value : block) value = std::min(value / first, 0.2F);
  const float second = std::sqrt(squares() + 1e-6F);
  for (float& value : block) value /= second;
}

FloatRows rows_of(const KeyframeRecords& keyframes) {
  FloatRows rows =
      make_float_rows(static_cast<std::size_t>(kHogColumns) * kHogRows * kBlock, keyframes.records.size());
  vo::parallel_for(rows.size(), [&](std::size_t i) {
    if (keyframes.records[i].size() != packed_size(kHogGrid))
      throw vo::Error("a keyframe", fmt::format("has a record of {} bytes", keyframes.records[i].size()),
                      fmt::format("{}, those of the descriptor hog", packed_size(kHogGrid)));
    std::ranges::copy(hog_of(unpack_cells(keyframes.records[i])), rows[i].begin());
  });
  return rows;
}

class Hog final : public Descriptor {
 public:
  [[nodiscard]] DescriptorTraits traits() const override {
    return {.max_shift = 4, .columns = kHogColumns, .metric = Metric::kCosine, .records_frames = true};
  }
  [[nodiscard]] Bytes record(const vo::Frame& frame) const override {
    return pack_cells(gradient_cells(frame.image, kHogGrid));
  }
  [[nodiscard]] Bytes learn(const KeyframeRecords& keyframes) const override {
    FloatRows rows = rows_of(keyframes);
    return pack_spread(spread_of(rows));
  }
  [[nodiscard]] Describe describer(std::span<const std::uint8_t> learned) const override {
    return [this, learned = Bytes(learned.begin(), learned.end())](
               const KeyframeRecords& keyframes) -> Descriptors {
      return standardised_columns(rows_of(keyframes), learned, kHogColumns);
    };
  }
};

}  // namespace

std::vector<float> hog_of(std::span<const float> cells) {
  if (cells.size() != kHogGrid.values())
    throw std::invalid_argument("hog_of: 8 x 16 cells of 12 directions expected");
  constexpr std::size_t kDirections = kHogGrid.directions;
  std::vector<float> out(static_cast<std::size_t>(kHogColumns) * kHogRows * kBlock);
  float* block = out.data();
  for (std::size_t x = 0; x < kHogColumns; ++x) {
    for (std::size_t y = 0; y < kHogRows; ++y, block += kBlock) {
      float* to = block;
      for (const std::size_t down : {0U, 1U})
        for (const std::size_t right : {0U, 1U})
          to = std::copy_n(cells.data() + ((y + down) * kHogGrid.columns + x + right) * kDirections,
                           kDirections, to);
      normalise_cells({block, static_cast<std::size_t>(kBlock)});
    }
  }
  return out;
}

std::unique_ptr<Descriptor> make_hog(const DescriptorOptions&) {
  return std::make_unique<Hog>();
}

}  // namespace place
