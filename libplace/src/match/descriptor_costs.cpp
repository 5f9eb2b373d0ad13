#include "place/match/descriptor_costs.hpp"

#include "place/match/cost_matrix.hpp"
#include "place/match/float_costs.hpp"
#include "place/match/shifted_cosine.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

namespace place {
namespace {

/// A shift in columns of a descriptor that has so many.
int shift_in_columns(const DescriptorTraits& traits, int columns, std::optional<int> max_shift_px) {
  if (!max_shift_px) return traits.max_shift;
  const double share = static_cast<double>(*max_shift_px) / kShiftWidth_px;
  return std::clamp(static_cast<int>(std::lround(share * columns)), 0, std::max(0, columns - 1));
}

/// The leading channels of every column as a picture, for `candidates`.
vo::ImageStack leading_channels(const ColumnStack& stack) {
  const int channels = std::min(16, stack.channels);
  vo::ImageStack images = vo::make_image_stack(channels, stack.columns, stack.size());
  for (std::size_t i = 0; i < stack.size(); ++i) {
    auto to = images[i].begin();
    for (int column = 0; column < stack.columns; ++column) {
      const std::int8_t* values = stack[i].data() + static_cast<std::ptrdiff_t>(column) * stack.channels;
      to = std::transform(values, values + channels, to,
                          [](std::int8_t value) { return static_cast<std::uint8_t>(value + 128); });
    }
  }
  return images;
}

}  // namespace

std::unique_ptr<CostSource> descriptor_costs(const Descriptors& queries, const Descriptors& references,
                                             const DescriptorTraits& traits,
                                             std::optional<int> max_shift_px) {
  if (queries.index() != references.index())
    throw std::invalid_argument("descriptor_costs: descriptors of one form expected");
  if (const auto* images = std::get_if<vo::ImageStack>(&queries)) {
    return std::make_unique<ThumbnailCosts>(
        *images, std::get<vo::ImageStack>(references),
        CostOptions{.max_shift_px = shift_in_columns(traits, images->width, max_shift_px)});
  }
  if (const auto* stack = std::get_if<ColumnStack>(&queries)) {
    const ShiftedCosineOptions options{.max_shift_columns =
                                           shift_in_columns(traits, traits.columns, max_shift_px)};
    return std::make_unique<ShiftedCosine>(*stack, std::get<ColumnStack>(references), options);
  }
  return std::make_unique<FloatCosts>(std::get<FloatRows>(queries), std::get<FloatRows>(references),
                                      traits.metric);
}

std::vector<std::size_t> candidates(const Descriptors& queries, const Descriptors& references,
                                    const CandidateOptions& options) {
  if (queries.index() != references.index())
    throw std::invalid_argument("candidates: descriptors of one form expected");
  if (const auto* images = std::get_if<vo::ImageStack>(&queries))
    return candidates(*images, std::get<vo::ImageStack>(references), options);
  CandidateOptions of_pictures = options;
  if (const auto pictures = candidate_pictures(queries, of_pictures))
    return candidates(*pictures, *candidate_pictures(references, of_pictures), of_pictures);
  std::vector<std::size_t> all(count_of(references));
  std::iota(all.begin(), all.end(), std::size_t{0});
  return all;
}

std::optional<vo::ImageStack> candidate_pictures(const Descriptors& descriptors, CandidateOptions& options) {
  if (const auto* images = std::get_if<vo::ImageStack>(&descriptors)) return *images;
  if (!std::holds_alternative<ColumnStack>(descriptors)) return {};
  options.pool_px = 1;
  return leading_channels(std::get<ColumnStack>(descriptors));
}

}  // namespace place
