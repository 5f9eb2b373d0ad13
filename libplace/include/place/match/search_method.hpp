#pragma once

#include "place/match/cost_matrix.hpp"
#include "place/match/matrix_part.hpp"
#include "place/match/search_options.hpp"
#include "place/match/sequence_search.hpp"

#include <span>
#include <string_view>
#include <vector>

namespace place {

/// What a search found, and how much it looked at.
struct SearchResult {
  std::vector<SequenceMatch> matches;  ///< one for each query, in order
  double looked_at = 1;                ///< share of the matrix's cells that were looked at
};

/// A way to turn enhanced costs into a place for each query. To add one: a file with its function, an entry
/// in the table, and a test.
struct SearchMethod {
  std::string_view name;     ///< as `--search` takes it
  std::string_view summary;  ///< one line
  /// `enhanced`: queries by references, lower is more alike, in standard deviations. Sequences cross no gap
  /// of `options.gaps`. The same bytes for any number of threads. Throws `std::invalid_argument` for options
  /// that are not valid.
  SearchResult (*search)(const CostView& enhanced, const SearchOptions& options);
  /// Hardly any right match scores below this quantile of wrong matches' scores (`MatchProbabilityOptions`).
  double decoy_quantile = 0.5;
  bool scores_are_log_odds = false;  ///< a score is log(p / (1 - p)) of the method's own probability p
  /// The same for a team whose members have a part of the matrix each; null if it needs the whole.
  SearchResult (*search_part)(const MatrixPart& part, const SearchOptions& options, Team& team) = nullptr;
};

/// All search methods; the first is the default.
std::span<const SearchMethod> search_methods();

/// The method with a name. Throws `vo::Error` naming all methods if there is none.
const SearchMethod& search_method(std::string_view name);

}  // namespace place
