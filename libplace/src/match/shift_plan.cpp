#include "match/shift_plan.hpp"

#include <algorithm>

namespace place {
namespace {

/// Writes spread columns one after another, from the columns of a descriptor; those outside it are 0.
class Spreader {
 public:
  Spreader(std::span<const std::int8_t> descriptor, std::size_t columns, std::size_t row_channels,
           std::span<std::int8_t> row)
      : descriptor_(descriptor.data()),
        columns_(static_cast<std::ptrdiff_t>(columns)),
        channels_(descriptor.size() / columns),
        row_channels_(row_channels),
        next_(row.data()) {}

  /// Column a + sign * column b.
  void write(std::ptrdiff_t a, int sign, std::ptrdiff_t b) {
    const std::int8_t *of_a = column(a), *of_b = column(b);
    if (of_a == nullptr && of_b == nullptr) {
      std::fill_n(next_, channels_, std::int8_t{0});
    } else if (of_b == nullptr) {
      std::copy_n(of_a, channels_, next_);
    } else {
      for (std::size_t k = 0; k < channels_; ++k) {
        const int left = of_a == nullptr ? 0 : of_a[k];
        next_[k] = static_cast<std::int8_t>(left + sign * of_b[k]);
      }
    }
    finish_column();
  }
  void write(std::ptrdiff_t a) { write(a, 1, kNone); }

 private:
  static constexpr std::ptrdiff_t kNone = -1;

  [[nodiscard]] const std::int8_t* column(std::ptrdiff_t i) const {
    return i < 0 || i >= columns_ ? nullptr : descriptor_ + static_cast<std::size_t>(i) * channels_;
  }
  void finish_column() {
    std::fill(next_ + channels_, next_ + row_channels_, std::int8_t{0});
    next_ += row_channels_;
  }

  const std::int8_t* descriptor_;
  std::ptrdiff_t columns_;
  std::size_t channels_, row_channels_;
  std::int8_t* next_;
};

/// Pairs of columns of one parity; a descriptor is padded with zeros to a multiple of four columns.
constexpr std::ptrdiff_t pairs_of(std::size_t columns) {
  return static_cast<std::ptrdiff_t>((columns + 3) / 4);
}

}  // namespace

ShiftPlan direct_plan(std::size_t columns, std::size_t max_shift) {
  ShiftPlan plan{.fast = false,
                 .columns = columns,
                 .query_columns = columns,
                 .reference_columns = columns,
                 .stretches = {}};
  for (std::size_t i = 0; i <= 2 * max_shift; ++i) {
    const std::size_t right = i > max_shift ? i - max_shift : 0, left = i < max_shift ? max_shift - i : 0;
    plan.stretches.push_back({right, left, columns - right - left});
  }
  return plan;
}

ShiftPlan fast_plan(std::size_t columns) {
  const auto pairs = static_cast<std::size_t>(pairs_of(columns));
  ShiftPlan plan{.fast = true,
                 .columns = columns,
                 .query_columns = 10 * pairs + 1,
                 .reference_columns = 10 * pairs,
                 .stretches = {}};
  for (std::size_t i = 0; i < 8; ++i) plan.stretches.push_back({i * pairs, i * pairs, pairs});
  plan.stretches.push_back({8 * pairs, 8 * pairs, 2 * pairs});      // X(-1)
  plan.stretches.push_back({8 * pairs + 1, 8 * pairs, 2 * pairs});  // X(0)
  return plan;
}

void spread_query(const ShiftPlan& plan, std::span<const std::int8_t> descriptor, std::size_t row_channels,
                  std::span<std::int8_t> row) {
  Spreader to(descriptor, plan.columns, row_channels, row);
  const auto columns = static_cast<std::ptrdiff_t>(plan.columns), pairs = pairs_of(plan.columns);
  if (!plan.fast) {
    for (std::ptrdiff_t i = 0; i < columns; ++i) to.write(i);
    return;
  }
  for (const std::ptrdiff_t parity : {0, 1}) {
    // d0 .. d3 of pair p are the columns 4 p - 2 .. 4 p + 4 of its parity.
    const auto d = [parity](std::ptrdiff_t p, std::ptrdiff_t k) { return 4 * p + 2 * (k - 1) + parity; };
    for (std::ptrdiff_t p = 0; p < pairs; ++p) to.write(d(p, 0), -1, d(p, 2));
    for (std::ptrdiff_t p = 0; p < pairs; ++p) to.write(d(p, 1), 1, d(p, 2));
    for (std::ptrdiff_t p = 0; p < pairs; ++p) to.write(d(p, 2), -1, d(p, 1));
    for (std::ptrdiff_t p = 0; p < pairs; ++p) to.write(d(p, 1), -1, d(p, 3));
  }
  for (std::ptrdiff_t i = -1; i < 2 * pairs; ++i) to.write(2 * i + 1, 1, 2 * i + 2);
}

void spread_reference(const ShiftPlan& plan, std::span<const std::int8_t> descriptor,
                      std::size_t row_channels, std::span<std::int8_t> row) {
  Spreader to(descriptor, plan.columns, row_channels, row);
  const auto columns = static_cast<std::ptrdiff_t>(plan.columns), pairs = pairs_of(plan.columns);
  if (!plan.fast) {
    for (std::ptrdiff_t i = 0; i < columns; ++i) to.write(i);
    return;
  }
  for (const std::ptrdiff_t parity : {0, 1}) {
    const auto g = [parity](std::ptrdiff_t p, std::ptrdiff_t k) { return 4 * p + 2 * k + parity; };
    for (std::ptrdiff_t p = 0; p < pairs; ++p) to.write(g(p, 0));
    for (std::ptrdiff_t p = 0; p < pairs; ++p) to.write(g(p, 0), 1, g(p, 1));
    for (std::ptrdiff_t p = 0; p < pairs; ++p) to.write(g(p, 0), -1, g(p, 1));
    for (std::ptrdiff_t p = 0; p < pairs; ++p) to.write(g(p, 1));
  }
  for (std::ptrdiff_t i = 0; i < 2 * pairs; ++i) to.write(2 * i, 1, 2 * i + 1);
}

}  // namespace place
