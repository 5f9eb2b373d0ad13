#include "io/pose_lines.hpp"

#include "vo/io/csv.hpp"
#include "vo/io/text_file.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include <fmt/format.h>

namespace vo {
namespace {

/// Takes the first cell off a text; empty if there is none.
std::string_view take_cell(std::string_view& text) {
  constexpr std::string_view kSeparators = " \t,;";
  text.remove_prefix(std::min(text.find_first_not_of(kSeparators), text.size()));
  const std::string_view cell = text.substr(0, std::min(text.find_first_of(kSeparators), text.size()));
  text.remove_prefix(cell.size());
  return cell;
}

bool is_name(std::string_view quoted) {
  const std::string_view cell = without_quotes(quoted);
  if (cell.empty()) return false;
  const char first = cell.front();
  const bool letter =
      (first >= 'a' && first <= 'z') || (first >= 'A' && first <= 'Z') || first == '"' || first == '\'';
  return letter && cell != "nan" && cell != "NaN" && cell != "inf";
}

}  // namespace

std::string NumberFile::where(const NumberLine& line) const {
  return fmt::format("{}: line {}", path, line.number);
}

std::string problem_of(const NumberLine& line) {
  return line.wrong.empty() ? fmt::format("has {} numbers", line.values.size())
                            : fmt::format("'{}' is no number", printable(line.wrong));
}

NumberFile read_number_lines(const std::filesystem::path& path, std::string_view expected) {
  TextFile text = read_text_file(path, expected);
  NumberFile file{.path = path.string(), .bytes = std::move(text.bytes), .lines = {}};
  file.lines.reserve(text.lines.size());
  bool first = true;
  for (const TextLine& line : text.lines) {
    std::string_view rest = trimmed(line.text);
    if (rest.empty() || rest.starts_with('#')) continue;
    std::string_view after = rest;
    const std::string_view one = take_cell(after), two = take_cell(after);
    if (one.empty()) continue;
    if (std::exchange(first, false) && !two.empty() && is_name(one) && is_name(two)) continue;
    NumberLine& numbers =
        file.lines.emplace_back(NumberLine{.number = line.number, .wrong = {}, .values = {}});
    for (std::string_view cell = take_cell(rest); !cell.empty(); cell = take_cell(rest)) {
      const std::optional<double> value = parse_number(without_quotes(cell));
      if (!value) {
        numbers.wrong = cell;
        break;
      }
      numbers.values.push_back(*value);
    }
  }
  return file;
}

}  // namespace vo
