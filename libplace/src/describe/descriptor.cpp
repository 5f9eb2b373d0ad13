#include "place/describe/descriptor.hpp"

#include "place/describe/blocks.hpp"
#include "place/describe/file_descriptor.hpp"
#include "place/describe/hog.hpp"
#include "place/describe/network.hpp"
#include "place/describe/thumbnail_descriptor.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <vo/base/error.hpp>

namespace place {
namespace {

struct Entry {
  std::string_view name;
  std::unique_ptr<Descriptor> (*make)(const DescriptorOptions&);
};

/// Every descriptor once.
constexpr std::array kDescriptors{
    Entry{"blocks", make_blocks},   Entry{"thumbnail", make_thumbnail}, Entry{"hog", make_hog},
    Entry{"network", make_network}, Entry{"file", make_file},
};

}  // namespace

Bytes Descriptor::record(const vo::Frame&) const {
  return {};
}

Bytes Descriptor::learn(const KeyframeRecords&) const {
  return {};
}

Descriptors Descriptor::comparable(const Descriptors& described) const {
  return described;
}

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

std::vector<std::string> descriptor_names() {
  std::vector<std::string> names;
  for (const Entry& entry : kDescriptors) names.emplace_back(entry.name);
  return names;
}

std::shared_ptr<const DescriptorSet> make_descriptors(const DescriptorOptions& options) {
  DescriptorSet made;
  for (std::size_t begin = 0; begin <= options.name.size();) {
    const std::size_t end = std::min(options.name.find('+', begin), options.name.size());
    const std::string name = options.name.substr(begin, end - begin);
    const auto entry = std::ranges::find(kDescriptors, std::string_view(name), &Entry::name);
    if (entry == kDescriptors.end())
      throw vo::Error("descriptor", fmt::format("'{}' is no descriptor", name),
                      fmt::format("{}, or several joined by '+'", fmt::join(descriptor_names(), ", ")));
    made.push_back(entry->make(options));
    begin = end + 1;
  }
  return std::make_shared<const DescriptorSet>(std::move(made));
}

}  // namespace place
