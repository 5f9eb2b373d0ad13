#include "matches_file.hpp"

#include <fmt/format.h>

#include <vo/base/error.hpp>
#include <vo/io/csv.hpp>

namespace retrace {
namespace {

std::string csv_field(const std::optional<double>& value) {
  return value ? fmt::format("{:.6g}", *value) : "";
}

}  // namespace

std::string matches_csv(const std::vector<place::Match>& matches) {
  std::string csv =
      "query_frame,query_time_s,traverse,reference_frame,reference_time_s,reference_distance_m,score,"
      "accepted\n";
  for (const place::Match& match : matches) {
    csv += fmt::format("{},{:.6f},", match.query_frame, match.query_time_s);
    if (match.place) {
      csv += fmt::format("{},{},{:.6f},{}", match.place->traverse, match.place->frame, match.place->time_s,
                         csv_field(match.place->distance_m));
    } else {
      csv += ",,,";
    }
    csv += fmt::format(",{:.9g},{}\n", match.score, match.accepted ? 1 : 0);
  }
  return csv;
}

std::vector<MatchRow> read_matches(const std::filesystem::path& path) {
  const vo::CsvTable table = vo::CsvTable::read(path);
  if (table.rows() == 0) throw vo::Error(path.string(), "has no rows", "one for each query keyframe");
  const std::vector<std::int64_t> query = table.indices("query_frame");
  const std::vector<std::optional<double>> reference = table.optional_numbers("reference_frame");
  const std::vector<std::optional<double>> score = table.optional_numbers("score");
  const std::vector<std::int64_t> accepted = table.indices("accepted");
  const auto optional_column = [&](const char* name) {
    return table.has(name) ? table.optional_numbers(name) : std::vector<std::optional<double>>(table.rows());
  };
  const std::vector<std::optional<double>> query_time_s = optional_column("query_time_s");
  const std::vector<std::optional<double>> reference_time_s = optional_column("reference_time_s");
  std::vector<std::string> traverse(table.rows());
  if (table.has("traverse")) traverse = table.text("traverse");
  std::vector<MatchRow> rows;
  for (std::size_t i = 0; i < table.rows(); ++i) {
    if (reference[i] && !score[i])
      throw vo::Error(table.where(i), "has a reference frame and no score", "a score for every match");
    MatchRow row{.query_frame = query[i],
                 .query_time_s = query_time_s[i].value_or(0),
                 .traverse = traverse[i],
                 .reference_frame = {},
                 .reference_time_s = reference_time_s[i].value_or(0),
                 .score = score[i].value_or(0),
                 .accepted = accepted[i] != 0};
    if (reference[i]) row.reference_frame = static_cast<std::int64_t>(*reference[i]);
    rows.push_back(std::move(row));
  }
  return rows;
}

}  // namespace retrace
