#include "place/evaluation/sweep_parts.hpp"

#include <algorithm>
#include <charconv>
#include <string_view>
#include <utility>

#include <vo/base/error.hpp>

namespace place {
namespace {

/// A whole number of at least 1; 0 for anything else.
std::size_t counted_from_one(std::string_view text) {
  std::size_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size() ? value : 0;
}

}  // namespace

SweepPart parse_part(const std::string& text) {
  const std::size_t slash = text.find('/');
  SweepPart part{0, 0};
  if (slash != std::string::npos) {
    part.number = counted_from_one(std::string_view(text).substr(0, slash));
    part.of = counted_from_one(std::string_view(text).substr(slash + 1));
  }
  if (part.number == 0 || part.number > part.of)
    throw vo::Error("--cell " + text, "is no part of a sweep", "I/N with 1 <= I <= N, as 2/8");
  return part;
}

PartRange range_of_part(const SweepPart& part, std::size_t total) {
  const auto border = [&](std::size_t i) { return total / part.of * i + total % part.of * i / part.of; };
  return {border(part.number - 1), border(part.number)};
}

std::vector<SweepCell> cells_by_work(const std::vector<SweepAxis>& axes) {
  std::vector<SweepCell> cells;
  for (const SweepCell& cell : all_cells(axes)) {
    if (std::ranges::find(cells, cell) == cells.end())
      cells.push_back(cell);  // a value may stand there twice
  }
  std::ranges::stable_sort(cells, {}, [&](const SweepCell& cell) {
    std::pair<SweepCell, SweepCell> key;
    for (std::size_t i = 0; i < axes.size(); ++i) {
      if (setting_named(axes[i].setting).at_reading) key.first.push_back(cell[i]);
      if (shapes_the_matrix(axes[i].setting)) key.second.push_back(cell[i]);
    }
    return key;
  });
  return cells;
}

}  // namespace place
