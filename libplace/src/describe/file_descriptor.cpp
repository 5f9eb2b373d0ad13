#include "place/describe/file_descriptor.hpp"

#include "place/describe/npy.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <fmt/format.h>

#include <vo/base/error.hpp>
#include <vo/io/csv.hpp>

namespace place {
namespace {

constexpr double kNear_s = 0.5;

class File final : public Descriptor {
 public:
  explicit File(DescriptorFileOptions options) : options_(std::move(options)) {
    if (options_.path.empty())
      throw vo::Error("descriptor-file", "is missing", "the walk's .npy file, with descriptor file");
  }

  [[nodiscard]] DescriptorTraits traits() const override { return {.metric = options_.metric}; }

  [[nodiscard]] Describe describer(std::span<const std::uint8_t>) const override {
    return [this](const KeyframeRecords& keyframes) -> Descriptors { return rows_of(keyframes); };
  }

 private:
  [[nodiscard]] FloatRows rows_of(const KeyframeRecords& keyframes) const {
    const FloatRows rows = read_npy(options_.path);
    const std::string beside = options_.path + ".csv";
    const vo::CsvTable table = vo::CsvTable::read(beside);
    const std::vector<std::int64_t> frames = table.indices("frame");
    const std::vector<double> time_s = table.numbers("time_s");
    if (frames.size() != rows.size())
      throw vo::Error(beside,
                      fmt::format("has {} rows and {} has {}", frames.size(), options_.path, rows.size()),
                      "as many");
    if (!std::ranges::is_sorted(time_s) || !std::ranges::is_sorted(frames))
      throw vo::Error(beside, "is not in the order of time", "increasing frame and time_s");

    FloatRows chosen = make_float_rows(rows.width, keyframes.size());
    for (std::size_t i = 0; i < keyframes.size(); ++i) {
      const auto frame = static_cast<std::int64_t>(keyframes.frames[i]);
      const auto after = std::ranges::lower_bound(frames, frame) - frames.begin();
      std::size_t nearest = static_cast<std::size_t>(after);
      if (nearest == frames.size() ||
          (nearest > 0 && frame - frames[nearest - 1] < frames[nearest] - frame)) {
        nearest = nearest > 0 ? nearest - 1 : 0;
      }
      if (frames.empty() ||
          (frames[nearest] != frame && std::abs(time_s[nearest] - keyframes.time_s[i]) > kNear_s)) {
        throw vo::Error(beside,
                        fmt::format("has no row within {} s of frame {} at {:.2f} s", kNear_s, frame,
                                    keyframes.time_s[i]),
                        "the descriptors of this walk, often enough");
      }
      std::ranges::copy(rows[nearest], chosen[i].begin());
    }
    return chosen;
  }

  DescriptorFileOptions options_;
};

}  // namespace

std::unique_ptr<Descriptor> make_file(const DescriptorOptions& options) {
  return std::make_unique<File>(options.file);
}

}  // namespace place
