#include "describe/standardised_columns.hpp"

#include "describe/learned_bytes.hpp"
#include "place/describe/quantise.hpp"

#include <fmt/format.h>

#include <vo/base/error.hpp>

namespace place {

Bytes pack_spread(const Spread& spread) {
  LearnedWriter writer;
  writer.add(spread.mean);
  writer.add(spread.deviation);
  return writer.take();
}

Spread unpack_spread(std::span<const std::uint8_t> bytes) {
  LearnedReader reader(bytes);
  FloatRows mean = reader.next();
  return {std::move(mean), reader.next()};
}

ColumnStack standardised_columns(FloatRows rows, std::span<const std::uint8_t> learned, int columns) {
  const Spread spread = unpack_spread(learned);
  if (spread.mean.width != rows.width || spread.deviation.width != rows.width)
    throw vo::Error("what the route learned",
                    fmt::format("is of {} values where descriptors have {}", spread.mean.width, rows.width),
                    "the same descriptor for all walks on a route");
  standardise(rows, spread);
  ColumnStack stack = make_column_stack(columns, static_cast<int>(rows.width) / columns, rows.size());
  constexpr float kStep = 4.0F / kLargestByte;  // standardised values have deviation 1
  for (std::size_t i = 0; i < rows.size(); ++i) quantise(rows[i], kStep, stack, i);
  return stack;
}

}  // namespace place
