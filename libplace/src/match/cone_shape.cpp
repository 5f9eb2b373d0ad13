#include "match/cone_shape.hpp"

namespace place {

ConeShape::ConeShape(const SequenceSearchOptions& options, std::size_t queries, std::size_t references)
    : queries_(queries),
      references_(references),
      min_terms_(std::max(1, static_cast<int>(std::ceil(options.min_fraction * options.length)))) {
  const std::vector<SearchLine> lines = search_lines(options);
  for (int k = 0; k < options.length; ++k) {
    const auto at = static_cast<std::size_t>(k);
    const auto [low, high] = std::minmax(lines.front().offsets[at], lines.back().offsets[at]);
    rows_.push_back({k - options.length / 2, low, high});
  }
  for (int terms = 0; terms <= options.length; ++terms)
    factors_.push_back(terms == 0 ? 0 : static_cast<float>(1 / std::sqrt(1.0 * terms * options.length)));
}

int ConeShape::terms(std::size_t query, std::size_t reference) const {
  int count = 0;
  for (const Row& row : rows_) {
    const auto [first, past] = touching(row);
    count += static_cast<int>(has_query(query, row) && reference >= first && reference < past);
  }
  return count;
}

}  // namespace place
