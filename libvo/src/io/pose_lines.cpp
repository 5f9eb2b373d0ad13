#include "io/pose_lines.hpp"

#include "vo/io/csv.hpp"
#include "vo/io/text_file.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

namespace vo {
namespace {

std::vector<std::string_view> cells_of(std::string_view text) {
  constexpr std::string_view kSeparators = " \t,;";
  std::vector<std::string_view> cells;
  for (std::size_t begin = text.find_first_not_of(kSeparators); begin != std::string_view::npos;
       begin = text.find_first_not_of(kSeparators, begin)) {
    const std::size_t end = std::min(text.find_first_of(kSeparators, begin), text.size());
    cells.push_back(text.substr(begin, end - begin));
    begin = end;
  }
  return cells;
}

bool is_name(std::string_view cell) {
  const char first = cell.front();
  const bool letter = (first >= 'a' && first <= 'z') || (first >= 'A' && first <= 'Z') || first == '"';
  return letter && cell != "nan" && cell != "NaN" && cell != "inf";
}

}  // namespace

std::vector<NumberLine> read_number_lines(const std::filesystem::path& path, std::string_view expected) {
  std::vector<NumberLine> lines;
  bool first = true;
  for (const TextLine& line : read_text_lines(path, expected)) {
    const std::string_view text = trimmed(line.text);
    if (text.empty() || text.starts_with('#')) continue;
    const std::vector<std::string_view> cells = cells_of(text);
    if (cells.empty()) continue;
    if (std::exchange(first, false) && cells.size() > 1 && is_name(cells[0]) && is_name(cells[1])) continue;
    NumberLine numbers{.where = fmt::format("{}: line {}", path.string(), line.number), .values = {}};
    for (const std::string_view cell : cells) {
      const std::optional<double> value = parse_number(cell);
      if (!value) {
        numbers.problem = fmt::format("'{}' is no number", printable(cell));
        break;
      }
      numbers.values.push_back(*value);
    }
    lines.push_back(std::move(numbers));
  }
  return lines;
}

}  // namespace vo
