#pragma once

#include "place/match/search_lines.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace place {

/// The part of the reference between the slowest and the fastest line through a pair, for each query of the
/// sequence.
class ConeShape {
 public:
  /// Throws `std::invalid_argument` for options that are not valid.
  ConeShape(const SequenceSearchOptions& options, std::size_t queries, std::size_t references);

  struct Row {
    std::ptrdiff_t along;      ///< of the query, from the pair
    std::ptrdiff_t low, high;  ///< of the reference, from the pair; inclusive
    [[nodiscard]] std::size_t width() const { return static_cast<std::size_t>(high - low) + 1; }
  };
  [[nodiscard]] const std::vector<Row>& rows() const { return rows_; }

  /// The number of a pair's rows that lie inside the queries and touch the reference.
  [[nodiscard]] int terms(std::size_t query, std::size_t reference) const;
  /// Whether that many are enough.
  [[nodiscard]] bool enough(int terms) const { return terms >= min_terms_; }
  /// 1 / sqrt(terms * length).
  [[nodiscard]] float factor(int terms) const { return factors_[static_cast<std::size_t>(terms)]; }
  /// References [first, past) whose row `row` touches the reference.
  [[nodiscard]] std::pair<std::size_t, std::size_t> touching(const Row& row) const {
    const auto count = static_cast<std::ptrdiff_t>(references_);
    return {static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(-row.high, 0, count)),
            static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(count - row.low, 0, count))};
  }
  [[nodiscard]] bool has_query(std::size_t query, const Row& row) const {
    const std::ptrdiff_t at = static_cast<std::ptrdiff_t>(query) + row.along;
    return at >= 0 && at < static_cast<std::ptrdiff_t>(queries_);
  }

 private:
  std::vector<Row> rows_;
  std::vector<float> factors_;
  std::size_t queries_, references_;
  int min_terms_;
};

}  // namespace place
