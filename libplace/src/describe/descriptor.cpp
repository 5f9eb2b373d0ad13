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
