#include "place/match/match_io.hpp"

#include "place/route/route_database.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include <vo/base/degrees.hpp>
#include <vo/base/error.hpp>
#include <vo/io/csv_columns.hpp>

namespace place {
namespace {

constexpr const char* kNumber = "a finite number";
constexpr const char* kIndex = "a whole number, 0 or greater";

Place& place_in(Match& match) {
  if (!match.place) match.place.emplace();
  return *match.place;
}

bool read_index(std::string_view cell, std::int64_t& index) {
  const std::optional<double> number = vo::parse_number(cell);
  constexpr double kExact = 9e15;  // a double holds whole numbers up to this
  if (!number || *number < 0 || *number != std::floor(*number) || *number > kExact) return false;
  index = static_cast<std::int64_t>(*number);
  return true;
}

bool read_number(std::string_view cell, double& value) {
  const std::optional<double> number = vo::parse_number(cell);
  if (number) value = *number;
  return number.has_value();
}

std::string cell_of(const std::optional<double>& value) {
  return value ? fmt::format("{:.6g}", *value) : std::string();
}

// The reference frame comes first among those of the place: it says whether there is one.
using Column = vo::CsvColumn<Match>;
constexpr std::array kColumns{
    Column{"query_frame", [](const Match& m) { return fmt::format("{}", m.query_frame); },
           [](Match& m, std::string_view cell) { return read_index(cell, m.query_frame); }, kIndex},
    Column{"query_time_s", [](const Match& m) { return fmt::format("{:.6f}", m.query_time_s); },
           [](Match& m, std::string_view cell) { return read_number(cell, m.query_time_s); }, kNumber, false},
    Column{"traverse", [](const Match& m) { return m.place ? m.place->traverse : std::string(); },
           [](Match& m, std::string_view cell) {
             if (!cell.empty()) place_in(m).traverse = cell;
             return true;
           },
           "", false},
    Column{"reference_frame",
           [](const Match& m) { return m.place ? fmt::format("{}", m.place->frame) : std::string(); },
           [](Match& m, std::string_view cell) {
             if (cell.empty()) m.place.reset();
             return cell.empty() || read_index(cell, place_in(m).frame);
           },
           kIndex},
    Column{"reference_time_s",
           [](const Match& m) { return m.place ? fmt::format("{:.6f}", m.place->time_s) : std::string(); },
           [](Match& m, std::string_view cell) {
             return !m.place || cell.empty() || read_number(cell, m.place->time_s);
           },
           kNumber, false},
    Column{"reference_distance_m",
           [](const Match& m) {
             return m.place && m.place->distance_m ? fmt::format("{:.6g}", *m.place->distance_m)
                                                   : std::string();
           },
           [](Match& m, std::string_view cell) {
             return !m.place || cell.empty() || read_number(cell, m.place->distance_m.emplace());
           },
           kNumber, false},
    Column{"score", [](const Match& m) { return fmt::format("{:.9g}", m.score); },
           [](Match& m, std::string_view cell) {
             return (!m.place && cell.empty()) || read_number(cell, m.score);
           },
           "a score for every match"},
    Column{"accepted", [](const Match& m) { return std::string(m.accepted ? "1" : "0"); },
           [](Match& m, std::string_view cell) {
             m.accepted = cell == "1";
             return cell == "1" || cell == "0";
           },
           "0 or 1"},
    Column{"probability", [](const Match& m) { return cell_of(m.probability); },
           [](Match& m, std::string_view cell) {
             return cell.empty() || (read_number(cell, m.probability.emplace()) && *m.probability >= 0 &&
                                     *m.probability <= 1);
           },
           "a probability", false},
    Column{"sd_keyframes", [](const Match& m) { return cell_of(m.sd_keyframes); },
           [](Match& m, std::string_view cell) {
             return cell.empty() || read_number(cell, m.sd_keyframes.emplace());
           },
           kNumber, false},
    Column{
        "sd_m", [](const Match& m) { return cell_of(m.sd_m); },
        [](Match& m, std::string_view cell) { return cell.empty() || read_number(cell, m.sd_m.emplace()); },
        kNumber, false},
    Column{"yaw_deg",
           [](const Match& m) {
             return m.yaw_rad ? fmt::format("{:.2f}", *m.yaw_rad * vo::kDegPerRad) : std::string();
           },
           [](Match& m, std::string_view cell) {
             if (cell.empty()) return true;
             const bool read = read_number(cell, m.yaw_rad.emplace());
             *m.yaw_rad /= vo::kDegPerRad;
             return read;
           },
           kNumber, false},
    Column{"lateral_m",
           [](const Match& m) { return m.lateral_m ? fmt::format("{:.3f}", *m.lateral_m) : std::string(); },
           [](Match& m, std::string_view cell) {
             return cell.empty() || read_number(cell, m.lateral_m.emplace());
           },
           kNumber, false},
    Column{"ahead_m",
           [](const Match& m) { return m.ahead_m ? fmt::format("{:.3f}", *m.ahead_m) : std::string(); },
           [](Match& m, std::string_view cell) {
             return cell.empty() || read_number(cell, m.ahead_m.emplace());
           },
           kNumber, false},
    Column{"nearest_place", [](const Match& m) { return vo::csv_cell(m.nearest_place); },
           [](Match& m, std::string_view cell) {
             m.nearest_place = cell;
             return true;
           },
           "", false},
    Column{"nearest_place_m", [](const Match& m) { return cell_of(m.nearest_place_m); },
           [](Match& m, std::string_view cell) {
             return cell.empty() || read_number(cell, m.nearest_place_m.emplace());
           },
           kNumber, false},
};

}  // namespace

std::string to_csv(std::span<const Match> matches) {
  return vo::to_csv<Match>(matches, kColumns);
}

std::vector<Match> read_matches(const std::filesystem::path& path) {
  std::vector<Match> matches = vo::read_csv<Match>(path, kColumns);
  if (matches.empty()) throw vo::Error(path.string(), "has no rows", "one for each query keyframe");
  for (std::size_t i = 0; i < matches.size(); ++i) {
    const Match& match = matches[i];
    if (i > 0 && match.query_frame <= matches[i - 1].query_frame)
      throw vo::Error(
          path.string(),
          fmt::format("has query_frame {} after {}", match.query_frame, matches[i - 1].query_frame),
          "a row for each query keyframe, in order");
    if (match.accepted && !match.place)
      throw vo::Error(path.string(), fmt::format("accepts query_frame {} without a place", match.query_frame),
                      "a reference_frame where accepted is 1");
  }
  return matches;
}

void locate(std::vector<Match>& matches, const Route& route) {
  for (Match& match : matches) {
    if (!match.place) continue;
    Place& place = *match.place;
    const auto traverse = std::ranges::find(route.traverses, place.traverse, &Traverse::name);
    if (traverse == route.traverses.end())
      throw vo::Error(fmt::format("traverse '{}'", place.traverse), "is not on the route",
                      "the route that the matches are on");
    const auto keyframe = std::ranges::lower_bound(traverse->keyframes, place.frame, {}, &Keyframe::frame);
    if (keyframe == traverse->keyframes.end() || keyframe->frame != place.frame)
      throw vo::Error(fmt::format("frame {}", place.frame),
                      fmt::format("is no keyframe of traverse '{}'", place.traverse),
                      "the route that the matches are on");
    place.keyframe = static_cast<std::size_t>(keyframe - traverse->keyframes.begin());
    place.time_s = keyframe->time_s;
    place.distance_m = keyframe->distance_m;
    place.pose = keyframe->pose;
  }
}

}  // namespace place
