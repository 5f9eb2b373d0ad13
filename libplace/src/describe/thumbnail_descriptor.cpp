#include "place/describe/thumbnail_descriptor.hpp"

namespace place {
namespace {

class Thumbnail final : public Descriptor {
 public:
  explicit Thumbnail(const vo::PatchNormalisationOptions& patch) : patch_(patch) {}
  [[nodiscard]] DescriptorTraits traits() const override { return {.columns = 64}; }
  [[nodiscard]] Describe describer(std::span<const std::uint8_t>) const override {
    return [](const KeyframeRecords& keyframes) -> Descriptors { return keyframes.thumbnails; };
  }
  [[nodiscard]] Descriptors comparable(const Descriptors& described) const override {
    return vo::patch_normalise(std::get<vo::ImageStack>(described), patch_);
  }

 private:
  vo::PatchNormalisationOptions patch_;
};

}  // namespace

std::unique_ptr<Descriptor> make_thumbnail(const DescriptorOptions& options) {
  return std::make_unique<Thumbnail>(options.patch);
}

}  // namespace place
