#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <vo/image/image_stack.hpp>

namespace place {

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
};

/// A block of a matrix, wherever it lies: queries from `first_query` on by references from `first_reference`
/// on, rows `stride` values apart.
template <typename Value>
struct CostBlock {
  std::size_t first_query = 0, queries = 0;
  std::size_t first_reference = 0, references = 0;
  Value* values = nullptr;
  std::size_t stride = 0;

  /// The row of the block's `i`-th query.
  [[nodiscard]] std::span<Value> row(std::size_t i) const { return {values + i * stride, references}; }
  /// All queries by references [first, first + count), counted as the matrix does.
  [[nodiscard]] CostBlock columns(std::size_t first, std::size_t count) const {
    return {first_query, queries, first, count, values + (first - first_reference), stride};
  }
  operator CostBlock<const Value>() const {
    return {first_query, queries, first_reference, references, values, stride};
  }
};
using Costs = CostBlock<float>;
using ConstCosts = CostBlock<const float>;

/// All of a matrix.
inline Costs block_of(CostMatrix& matrix) {
  return {0, matrix.queries, 0, matrix.references, matrix.values.data(), matrix.references};
}
inline ConstCosts block_of(const CostMatrix& matrix) {
  return {0, matrix.queries, 0, matrix.references, matrix.values.data(), matrix.references};
}

/// A matrix of zeros.
CostMatrix make_cost_matrix(std::size_t queries, std::size_t references);

/// What is known of costs before they come.
struct CostRange {
  double centre = 0;   ///< their mean
  double largest = 0;  ///< no cost is further than this from it
};

/// The mean of costs and how far they lie from it.
CostRange range_of(std::span<const float> costs);

/// Settings of `cost_matrix`.
struct CostOptions {
  /// Pixels of the descriptor. A pair's cost is the least over the query moved by up to so many to either
  /// side, for walkers who look a little to the side; 0 compares it as it is. Every shift is judged on the
  /// same part of the reference, that which all of them cover, so that none has an advantage; the outer
  /// columns do not count.
  int max_shift_px = 0;
};

/// The costs of a matrix, made block by block as they are asked for.
class CostSource {
 public:
  /// The stacks are bytes of `vo::patch_normalise`, of the same width and height, and must outlive this.
  /// Throws `std::invalid_argument` if the sizes differ or the shift leaves no column. With a shift, copies
  /// the references and 2 * max_shift_px + 1 times the queries.
  CostSource(const vo::ImageStack& queries, const vo::ImageStack& references,
             const CostOptions& options = {});

  [[nodiscard]] std::size_t queries() const { return queries_; }
  [[nodiscard]] std::size_t references() const { return reference_images().size(); }
  /// Every cost is `float(n) * unit()` of a whole number n.
  [[nodiscard]] float unit() const;

  /// Writes the values of a block. In parallel.
  void compute(const Costs& block) const;

 private:
  [[nodiscard]] const vo::ImageStack& query_images() const { return variants_ > 1 ? shifted_ : *whole_; }
  [[nodiscard]] const vo::ImageStack& reference_images() const {
    return variants_ > 1 ? cropped_ : *whole_references_;
  }

  std::size_t queries_;
  std::size_t variants_ = 1;  ///< of each query, one after another
  const vo::ImageStack* whole_;
  const vo::ImageStack* whole_references_;
  vo::ImageStack shifted_, cropped_;
};

/// Mean absolute difference of patch-normalised descriptors, in standard deviations of a patch (SSS 3.1
/// and 3.4; SeqSLAM's image difference). Sums are exact integers, so every instruction set gives the same
/// bytes.
///
/// Both stacks: bytes of `vo::patch_normalise`, of the same width and height. Throws `std::invalid_argument`
/// if the sizes differ or the shift leaves no column. O(queries * references * pixels * (2 * shift + 1)), in
/// parallel.
CostMatrix cost_matrix(const vo::ImageStack& queries, const vo::ImageStack& references,
                       const CostOptions& options = {});

}  // namespace place
