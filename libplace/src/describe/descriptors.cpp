// What descriptors of every kind have in common; descriptor.cpp makes them.
#include "place/describe/descriptor.hpp"

#include <algorithm>
#include <stdexcept>

namespace place {
namespace {

/// Rows of `size` values at `indices`.
template <typename Values>
Values rows_at(const Values& values, std::size_t size, std::span<const std::size_t> indices) {
  Values chosen(indices.size() * size);
  for (std::size_t i = 0; i < indices.size(); ++i) {
    if ((indices[i] + 1) * size > values.size()) throw std::out_of_range("select: no such descriptor");
    std::copy_n(values.begin() + static_cast<std::ptrdiff_t>(indices[i] * size), size,
                chosen.begin() + static_cast<std::ptrdiff_t>(i * size));
  }
  return chosen;
}

}  // namespace

Descriptors select(const Descriptors& descriptors, std::span<const std::size_t> indices) {
  if (const auto* images = std::get_if<vo::ImageStack>(&descriptors)) return vo::select(*images, indices);
  if (const auto* stack = std::get_if<ColumnStack>(&descriptors))
    return ColumnStack{stack->columns, stack->channels,
                       rows_at(stack->values, stack->descriptor_size(), indices)};
  const auto& rows = std::get<FloatRows>(descriptors);
  return FloatRows{rows.width, rows_at(rows.values, rows.width, indices)};
}

std::size_t count_of(const Descriptors& descriptors) {
  return std::visit([](const auto& rows) { return rows.size(); }, descriptors);
}

std::size_t bytes_of_each(const Descriptors& descriptors) {
  if (const auto* images = std::get_if<vo::ImageStack>(&descriptors)) return images->image_size();
  if (const auto* stack = std::get_if<ColumnStack>(&descriptors)) return stack->descriptor_size();
  return std::get<FloatRows>(descriptors).width * sizeof(float);
}

}  // namespace place
