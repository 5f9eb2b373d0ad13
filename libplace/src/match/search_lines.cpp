#include "place/match/search_lines.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include <fmt/format.h>

namespace place {
namespace {

constexpr double kLargestRangeRad = 0.8;  // SSS 5.1
constexpr double kLargestSlope = 200;

std::vector<double> slopes_of(const SequenceSearchOptions& options) {
  std::vector<double> slopes;
  if (options.v_min) {
    const int steps = static_cast<int>(std::floor((*options.v_max - *options.v_min) * options.length + 1e-9));
    for (int i = 0; i <= steps; ++i)
      slopes.push_back(*options.v_min + static_cast<double>(i) / options.length);
  } else {
    const double range_rad = std::min(options.search_range_rad, kSteepestRangeRad);
    for (int i = 0; i < options.slopes; ++i) {
      const double share = options.slopes == 1 ? 0 : 2.0 * i / (options.slopes - 1) - 1;
      slopes.push_back(std::tan(std::numbers::pi / 4 + share * range_rad));
    }
  }
  return slopes;
}

}  // namespace

bool SequenceSearchOptions::is_valid(std::string* reason) const {
  const auto invalid = [&](std::string text) {
    if (reason != nullptr) *reason = std::move(text);
    return false;
  };
  if (length < 1) return invalid(fmt::format("sequence length is {}; at least 1 expected", length));
  if (!(search_range_rad >= 0 && search_range_rad <= kLargestRangeRad)) {
    return invalid(
        fmt::format("search range is {} rad; 0 <= range <= {} expected", search_range_rad, kLargestRangeRad));
  }
  if (slopes < 1) return invalid(fmt::format("slopes is {}; at least 1 expected", slopes));
  if (v_min.has_value() != v_max.has_value())
    return invalid("v_min and v_max go together; both or neither expected");
  if (v_min && !(*v_min > 0 && *v_min <= *v_max && *v_max <= kLargestSlope)) {
    return invalid(fmt::format("velocities are {}..{}; 0 < v_min <= v_max <= {} expected", *v_min, *v_max,
                               kLargestSlope));
  }
  if (!(min_fraction > 0 && min_fraction <= 1)) {
    return invalid(fmt::format("min fraction is {}; 0 < fraction <= 1 expected", min_fraction));
  }
  if (uniqueness_window < 0)
    return invalid(fmt::format("uniqueness window is {}; >= 0 expected", uniqueness_window));
  return true;
}

std::vector<SearchLine> search_lines(const SequenceSearchOptions& options) {
  if (std::string reason; !options.is_valid(&reason)) throw std::invalid_argument("search_lines: " + reason);
  std::vector<SearchLine> lines;
  for (const double slope : slopes_of(options)) {
    SearchLine line{.slope = slope, .offsets = {}};
    for (int k = 0; k < options.length; ++k) {
      line.offsets.push_back(static_cast<int>(std::lround((k - options.length / 2) * slope)));
    }
    if (lines.empty() || lines.back().offsets != line.offsets) lines.push_back(std::move(line));
  }
  return lines;
}

std::size_t reach_of(const std::vector<SearchLine>& lines) {
  int reach = 0;
  for (const SearchLine& line : lines)
    reach = std::max({reach, -line.offsets.front(), line.offsets.back()});  // they never decrease
  return static_cast<std::size_t>(reach);
}

}  // namespace place
