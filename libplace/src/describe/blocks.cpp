#include "place/describe/blocks.hpp"

#include "describe/learned_bytes.hpp"
#include "place/describe/dense_blocks.hpp"
#include "place/describe/gradient_cells.hpp"
#include "place/describe/quantise.hpp"
#include "place/describe/vlad.hpp"
#include "place/describe/words.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <stdexcept>

#include <fmt/format.h>

#include <vo/base/error.hpp>
#include <vo/base/parallel.hpp>
#include <vo/base/rng.hpp>

namespace place {
namespace {

// Chosen on the park, the office corridor and the footpath (tests/RESULTS.md).
constexpr std::size_t kBlockAxes = 64;
constexpr std::size_t kVocabularies = 4;
constexpr std::size_t kWords = 16;
constexpr int kRows = 3, kColumns = 8;
constexpr int kChannels = 128;
constexpr int kMaxShift = 2;
constexpr double kPriorQueries = 30;
/// Axes are scaled by their variance to the power of minus this, so that the few largest, which separate open
/// ground from walls, do not hide those that separate places. 0.5 would whiten.
constexpr double kEvening = 0.2;
// Larger samples are no better.
constexpr std::size_t kSampledKeyframes = 200;
constexpr std::size_t kSampledBlocks = 20'000;
constexpr std::size_t kColumnKeyframes = 100;  // from whose columns the column axes are learned

const CellGrid kGrid{};

VladGrid vlad_grid() {
  constexpr double kMargin = (kBlockCells - 1) / 2.0;
  return {.down = kGrid.rows - kBlockCells + 1,
          .across = kGrid.columns - kBlockCells + 1,
          .margin_y = kMargin,
          .margin_x = kMargin,
          .rows = kRows,
          .columns = kColumns};
}

FloatRows blocks_of(const Bytes& record) {
  if (record.size() != packed_size(kGrid))
    throw vo::Error("a keyframe", fmt::format("has a record of {} bytes", record.size()),
                    fmt::format("{}, those of the descriptor blocks", packed_size(kGrid)));
  return dense_blocks(unpack_cells(record), kGrid);
}

/// The columns of one picture, for one vocabulary after another.
FloatRows columns_of(const FloatRows& projected, const std::vector<FloatRows>& vocabularies) {
  std::vector<FloatRows> parts;
  std::size_t width = 0;
  for (const FloatRows& words : vocabularies) {
    parts.push_back(vlad_columns(projected, words, vlad_grid()));
    width += parts.back().width;
  }
  FloatRows columns = make_float_rows(width, kColumns);
  for (std::size_t c = 0; c < columns.size(); ++c) {
    auto to = columns[c].begin();
    for (const FloatRows& part : parts) to = std::ranges::copy(part[c], to).out;
  }
  return columns;
}

std::vector<std::size_t> evenly_spaced(std::size_t count, std::size_t of) {
  std::vector<std::size_t> indices;
  for (std::size_t i = 0; i < count; ++i) indices.push_back(i * of / count);
  return indices;
}

/// `wanted` rows of a picture, one drawn from each of as many equal stretches.
FloatRows sample_of(const FloatRows& rows, std::size_t wanted, std::uint64_t seed) {
  const std::size_t total = rows.size(), count = std::min(wanted, total);
  FloatRows sample = make_float_rows(rows.width, count);
  vo::Rng rng(seed);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t first = i * total / count, past = (i + 1) * total / count;
    std::ranges::copy(rows[first + rng.index(past - first)], sample[i].begin());
  }
  return sample;
}

FloatRows joined(const std::vector<FloatRows>& parts) {
  FloatRows all{.width = parts.front().width, .values = {}};
  for (const FloatRows& part : parts)
    all.values.insert(all.values.end(), part.values.begin(), part.values.end());
  return all;
}

/// Scales the axes, see kEvening. Returns the columns along them.
FloatRows even_out(const FloatRows& columns, PrincipalAxes& axes) {
  FloatRows along = project(columns, axes);
  std::vector<double> squares(along.width);
  for (std::size_t i = 0; i < along.size(); ++i)
    for (std::size_t k = 0; k < along.width; ++k)
      squares[k] += static_cast<double>(along[i][k]) * along[i][k];
  for (std::size_t k = 0; k < along.width; ++k) {
    const auto scale = static_cast<float>(std::pow(squares[k] / squares[0], -kEvening));
    if (!std::isfinite(scale)) continue;
    for (float& value : axes.axes[k]) value *= scale;
    for (std::size_t i = 0; i < along.size(); ++i) along[i][k] *= scale;
  }
  return along;
}

/// A model, arranged for describing.
struct ReadyModel {
  explicit ReadyModel(const BlocksModel& model)
      : of_blocks(model.block_axes),
        vocabularies(model.vocabularies),
        of_columns(model.column_axes),
        step(model.step) {}
  Projection of_blocks;
  std::vector<FloatRows> vocabularies;
  Projection of_columns;
  float step;
};

/// Descriptors before rounding, one row each.
FloatRows described(std::span<const Bytes> records, const ReadyModel& model) {
  std::vector<FloatRows> columns;
  for (const Bytes& record : records)
    columns.push_back(columns_of(model.of_blocks(blocks_of(record)), model.vocabularies));
  FloatRows rows = make_float_rows(static_cast<std::size_t>(kColumns) * kChannels, records.size());
  const FloatRows along = model.of_columns(joined(columns));
  for (std::size_t i = 0; i < along.size(); ++i)  // a short walk has fewer axes; the rest are 0
    std::ranges::copy(along[i],
                      rows[i / kColumns].begin() + static_cast<std::ptrdiff_t>(i % kColumns * kChannels));
  return rows;
}

ColumnStack describe_records(std::span<const Bytes> records, const ReadyModel& model) {
  ColumnStack stack = make_column_stack(kColumns, kChannels, records.size());
  constexpr std::size_t kTogether = 8;  // keyframes processed for each reading of the axes
  vo::parallel_for((records.size() + kTogether - 1) / kTogether, [&](std::size_t part) {
    const std::size_t first = part * kTogether, count = std::min(kTogether, records.size() - first);
    const FloatRows rows = described(records.subspan(first, count), model);
    for (std::size_t i = 0; i < count; ++i) quantise(rows[i], model.step, stack, first + i);
  });
  return stack;
}

class Blocks final : public Descriptor {
 public:
  [[nodiscard]] DescriptorTraits traits() const override {
    return {.max_shift = kMaxShift,
            .columns = kColumns,
            .prior_queries = kPriorQueries,
            .metric = Metric::kCosine,
            .records_frames = true};
  }
  [[nodiscard]] Bytes record(const vo::Frame& frame) const override {
    return pack_cells(gradient_cells(frame.image, kGrid));
  }
  [[nodiscard]] Bytes learn(const KeyframeRecords& keyframes) const override {
    return pack_blocks(learn_blocks(keyframes.records));
  }
  [[nodiscard]] Describe describer(std::span<const std::uint8_t> learned) const override {
    return [model = std::make_shared<const ReadyModel>(unpack_blocks(learned))](
               const KeyframeRecords& keyframes) -> Descriptors {
      return describe_records(keyframes.records, *model);
    };
  }
};

}  // namespace

BlocksModel learn_blocks(std::span<const Bytes> records) {
  if (records.empty()) throw std::invalid_argument("learn_blocks: keyframes expected");
  const std::vector<std::size_t> chosen =
      evenly_spaced(std::min(kSampledKeyframes, records.size()), records.size());
  const std::size_t of_each = (kSampledBlocks + chosen.size() - 1) / chosen.size();
  std::vector<FloatRows> parts(chosen.size());
  vo::parallel_for(chosen.size(),
                   [&](std::size_t i) { parts[i] = sample_of(blocks_of(records[chosen[i]]), of_each, i); });

  BlocksModel model;
  const FloatRows blocks = joined(parts);
  model.block_axes = principal_axes(blocks, kBlockAxes);
  if (model.block_axes.axes.size() == 0) {  // uniform grey throughout: any axis will do
    model.block_axes.axes = make_float_rows(blocks.width, 1);
    model.block_axes.axes[0][0] = 1;
  }
  const Projection of_blocks(model.block_axes);
  const FloatRows projected = of_blocks(blocks);
  for (std::uint32_t seed = 1; seed <= kVocabularies; ++seed)
    model.vocabularies.push_back(learn_words(projected, kWords, seed));

  const std::vector<std::size_t> fewer =
      evenly_spaced(std::min(kColumnKeyframes, records.size()), records.size());
  parts.resize(fewer.size());
  vo::parallel_for(fewer.size(), [&](std::size_t i) {
    parts[i] = columns_of(of_blocks(blocks_of(records[fewer[i]])), model.vocabularies);
  });
  const FloatRows columns = joined(parts);
  model.column_axes = principal_axes(columns, kChannels);
  model.column_axes.mean.clear();
  model.step = quantisation_step(even_out(columns, model.column_axes).values);
  return model;
}

ColumnStack describe_blocks(std::span<const Bytes> records, const BlocksModel& model) {
  return describe_records(records, ReadyModel(model));
}

Bytes pack_blocks(const BlocksModel& model) {
  LearnedWriter writer;
  writer.add({.width = model.block_axes.mean.size(), .values = model.block_axes.mean});
  writer.add(model.block_axes.axes);
  for (const FloatRows& words : model.vocabularies) writer.add(words);
  writer.add_coarsely(model.column_axes.axes);
  writer.add({.width = 1, .values = {model.step}});
  return writer.take();
}

BlocksModel unpack_blocks(std::span<const std::uint8_t> bytes) {
  LearnedReader reader(bytes);
  BlocksModel model;
  model.block_axes.mean = reader.next().values;
  model.block_axes.axes = reader.next();
  for (std::size_t i = 0; i < kVocabularies; ++i) model.vocabularies.push_back(reader.next());
  model.column_axes.axes = reader.next_coarse();
  const FloatRows step = reader.next();
  const std::size_t block = kBlockCells * kBlockCells * static_cast<std::size_t>(kGrid.directions);
  std::size_t column = 0;
  for (const FloatRows& words : model.vocabularies) column += kRows * words.values.size();
  if (model.block_axes.mean.size() != block || model.block_axes.axes.width != block || column == 0 ||
      model.vocabularies.front().width != model.block_axes.axes.size() ||
      (model.column_axes.axes.size() > 0 && model.column_axes.axes.width != column) ||
      model.column_axes.axes.size() > kChannels || step.size() != 1 || !(step.values[0] > 0)) {
    throw vo::Error("what the route learned", "is no vocabulary of the descriptor blocks",
                    "a route that retrace build has written");
  }
  model.step = step.values[0];
  return model;
}

std::unique_ptr<Descriptor> make_blocks(const DescriptorOptions&) {
  return std::make_unique<Blocks>();
}

}  // namespace place
