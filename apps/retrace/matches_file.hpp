#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <place/match/match.hpp>

namespace retrace {

/// A row of matches.csv, as far as it is read again.
struct MatchRow {
  std::int64_t query_frame = 0;
  double query_time_s = 0;
  std::string traverse;
  std::optional<std::int64_t> reference_frame;
  double reference_time_s = 0;
  double score = 0;
  bool accepted = false;
};

/// matches.csv, one row for each query keyframe.
std::string matches_csv(const std::vector<place::Match>& matches);

/// Reads it back. Times and traverses may be missing. Throws `vo::Error` naming file and line for anything
/// else that is, a match without a score, or no rows.
std::vector<MatchRow> read_matches(const std::filesystem::path& path);

}  // namespace retrace
