#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace place {

/// A matrix that is only looked at, where it is: a `CostMatrix`, or other memory of that form.
struct CostView {
  std::size_t queries = 0;
  std::size_t references = 0;
  std::span<const float> values;  ///< row after row

  [[nodiscard]] std::span<const float> row(std::size_t query) const {
    return values.subspan(query * references, references);
  }
  [[nodiscard]] float at(std::size_t query, std::size_t reference) const {
    return values[query * references + reference];
  }
};

/// A value for every (query, reference) pair of keyframes. One row per query; the reference index runs along
/// the row, contiguous in memory. Lower means more alike.
struct CostMatrix {
  std::size_t queries = 0;
  std::size_t references = 0;
  std::vector<float> values;

  [[nodiscard]] std::span<const float> row(std::size_t query) const {
    return std::span(values).subspan(query * references, references);
  }
  [[nodiscard]] std::span<float> row(std::size_t query) {
    return std::span(values).subspan(query * references, references);
  }
  [[nodiscard]] float at(std::size_t query, std::size_t reference) const {
    return values[query * references + reference];
  }
  operator CostView() const { return {queries, references, values}; }
};

/// A block of a matrix in any storage: queries from `first_query` on by references from `first_reference` on,
/// rows `stride` values apart.
template <typename Value>
struct CostBlock {
  std::size_t first_query = 0, queries = 0;
  std::size_t first_reference = 0, references = 0;
  Value* values = nullptr;
  std::size_t stride = 0;

  /// The row of the block's `i`-th query.
  [[nodiscard]] std::span<Value> row(std::size_t i) const { return {values + i * stride, references}; }
  /// All queries by references [first, first + count), in indices of the matrix.
  [[nodiscard]] CostBlock columns(std::size_t first, std::size_t count) const {
    return {first_query, queries, first, count, values + (first - first_reference), stride};
  }
  operator CostBlock<const Value>() const {
    return {first_query, queries, first_reference, references, values, stride};
  }
};
using Costs = CostBlock<float>;
using ConstCosts = CostBlock<const float>;

/// A whole matrix.
inline Costs block_of(CostMatrix& matrix) {
  return {0, matrix.queries, 0, matrix.references, matrix.values.data(), matrix.references};
}
inline ConstCosts block_of(const CostView& matrix) {
  return {0, matrix.queries, 0, matrix.references, matrix.values.data(), matrix.references};
}

/// A matrix of zeros.
CostMatrix make_cost_matrix(std::size_t queries, std::size_t references);

/// What is known of costs in advance.
struct CostRange {
  double centre = 0;   ///< their mean
  double largest = 0;  ///< largest distance of a cost from the mean
};

/// The mean of costs and their largest distance from it.
CostRange range_of(std::span<const float> costs);

/// The costs of a matrix, computed block by block on request: the seam between descriptors and search.
class CostSource {
 public:
  virtual ~CostSource() = default;

  [[nodiscard]] virtual std::size_t queries() const = 0;
  [[nodiscard]] virtual std::size_t references() const = 0;
  /// Every cost is `float(n) * unit()` for a whole number n >= 0.
  [[nodiscard]] virtual float unit() const = 0;

  /// Writes the values of a block, which do not depend on how the matrix is cut into blocks. In parallel.
  virtual void compute(const Costs& block) const = 0;
};

/// All costs of a source.
CostMatrix cost_matrix(const CostSource& source);

}  // namespace place
