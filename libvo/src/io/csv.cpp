#include "vo/io/csv.hpp"

#include "vo/base/error.hpp"
#include "vo/io/text_file.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace vo {
namespace {

/// The cells of a line, without the quotes around them.
std::vector<std::string> split(std::string_view line, char separator) {
  std::vector<std::string> cells(1);
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (quoted && c == '"' && i + 1 < line.size() && line[i + 1] == '"') {
      cells.back() += line[++i];  // a doubled quote is one of the cell's
    } else if (quoted) {
      if (c == '"') {
        quoted = false;
      } else {
        cells.back() += c;
      }
    } else if (c == '"' && trimmed(cells.back()).empty()) {
      quoted = true;
    } else if (c == separator) {
      cells.emplace_back();
    } else {
      cells.back() += c;
    }
  }
  for (std::string& cell : cells) cell = trimmed(cell);
  return cells;
}

/// Commas, semicolons or tabs, whichever a header has most of outside quotes.
char separator_of(std::string_view header) {
  constexpr std::array kSeparators{',', ';', '\t'};
  std::array<std::size_t, kSeparators.size()> count{};
  bool quoted = false;
  for (const char c : header) {
    if (c == '"') quoted = !quoted;
    for (std::size_t i = 0; !quoted && i < kSeparators.size(); ++i) count[i] += c == kSeparators[i] ? 1 : 0;
  }
  return kSeparators[static_cast<std::size_t>(std::ranges::max_element(count) - count.begin())];
}

/// Column names are the same in capitals too.
bool same_name(std::string_view a, std::string_view b) {
  return std::ranges::equal(
      a, b, [](unsigned char c, unsigned char d) { return std::tolower(c) == std::tolower(d); });
}

/// Whether a cell says that there is no value, as spreadsheets, R, pandas and Matlab write that.
bool says_unknown(std::string_view cell) {
  constexpr std::array<std::string_view, 7> kWords{"", "#n/a", "n/a", "na", "nan", "null", "-"};
  return std::ranges::any_of(kWords, [&](std::string_view word) { return same_name(cell, word); });
}

bool all_empty(const std::vector<std::string>& cells) {
  return std::ranges::all_of(cells, [](const std::string& cell) { return cell.empty(); });
}

/// Whether a `#` line is the header of the rows after it: names over as many numbers.
bool heads(std::string_view comment, std::string_view next_line) {
  const char separator = separator_of(comment);
  const auto names = split(comment, separator), values = split(next_line, separator);
  const auto is_number = [](const std::string& cell) { return parse_number(cell, true).has_value(); };
  return names.size() > 1 && names.size() == values.size() && std::ranges::none_of(names, is_number) &&
         std::ranges::all_of(values, is_number);
}

/// The lines of a file that say something, the header first, which `separator` is that of.
std::vector<TextLine> lines_from_header(const std::filesystem::path& path, char& separator) {
  std::vector<TextLine> lines = read_text_lines(path, "a CSV file");
  std::erase_if(lines, [](const TextLine& line) { return trimmed(line.text).empty(); });
  std::size_t first = 0;
  std::optional<char> said;
  for (; first < lines.size(); ++first) {
    const std::string_view text = trimmed(lines[first].text);
    if (text.starts_with("sep=") && text.size() <= 5) {
      said = text.size() == 5 ? text[4] : '\t';  // whose tab was trimmed
    } else if (!text.starts_with('#')) {
      break;
    } else if (first + 1 < lines.size() && heads(text.substr(1), lines[first + 1].text)) {
      lines[first].text = text.substr(1);
      break;
    }
  }
  lines.erase(lines.begin(), lines.begin() + static_cast<std::ptrdiff_t>(first));
  if (lines.empty()) throw Error(path.string(), "is empty", "a CSV file with a header line");
  separator = said.value_or(separator_of(lines[0].text));
  return lines;
}

}  // namespace

std::optional<double> parse_number(std::string_view text, bool decimal_commas) {
  std::string with_point(trimmed(text));
  if (decimal_commas && with_point.find('.') == std::string::npos) std::ranges::replace(with_point, ',', '.');
  const char* begin = with_point.data();
  const char* const end = begin + with_point.size();
  if (begin + 1 < end && *begin == '+' && begin[1] != '-') ++begin;
  double value = 0;
  const auto [rest, error] = std::from_chars(begin, end, value);
  if (error != std::errc{} || rest != end || !std::isfinite(value)) return std::nullopt;
  return value;
}

CsvTable CsvTable::read(const std::filesystem::path& path, UnevenRows uneven) {
  CsvTable table;
  table.path_ = path.string();
  char separator = ',';
  const std::vector<TextLine> lines = lines_from_header(path, separator);
  table.header_ = split(lines[0].text, separator);
  for (std::size_t i = 1; i < lines.size(); ++i) {
    if (trimmed(lines[i].text).starts_with('#')) continue;
    std::vector<std::string> cells = split(lines[i].text, separator);
    if (all_empty(cells)) continue;
    if (cells.size() != table.header_.size()) {
      if (uneven == UnevenRows::kRefuse) {
        throw Error(fmt::format("{}: line {}", table.path_, lines[i].number),
                    fmt::format("has {} cells", cells.size()),
                    fmt::format("{} as in the header", table.header_.size()));
      }
      ++table.left_out_;
      continue;
    }
    table.cells_.push_back(std::move(cells));
    table.lines_.push_back(lines[i].number);
  }
  table.find_decimal_mark(separator);
  return table;
}

void CsvTable::find_decimal_mark(char separator) {
  // Where commas do not separate, one in a number is its decimal mark. Where they do, a quoted "1,234" may be
  // a thousand: only other groups than of three digits say that the file has decimal commas.
  decimal_commas_ = separator != ',';
  for (std::size_t row = 0; row < cells_.size() && !decimal_commas_; ++row) {
    for (const std::string& cell : cells_[row]) {
      const std::size_t comma = cell.rfind(',');
      if (comma != std::string::npos && cell.size() - comma - 1 != 3 && parse_number(cell, true))
        decimal_commas_ = true;
    }
  }
}

bool CsvTable::has(std::string_view column) const {
  return std::ranges::any_of(header_, [&](const std::string& name) { return same_name(name, column); });
}

std::size_t CsvTable::column_index(std::string_view column) const {
  const auto found =
      std::ranges::find_if(header_, [&](const std::string& name) { return same_name(name, column); });
  if (found == header_.end()) {
    throw Error(path_, fmt::format("has no column '{}'", column),
                fmt::format("it among those there are ({})", fmt::join(header_, ", ")));
  }
  return static_cast<std::size_t>(found - header_.begin());
}

std::string CsvTable::where(std::size_t row) const {
  return fmt::format("{}: line {}", path_, lines_.at(row));
}

std::string CsvTable::no_value(std::string_view column, std::size_t row) const {
  const std::string& cell = cells_.at(row)[column_index(column)];
  return cell.empty() ? fmt::format("{} is empty", column) : fmt::format("{} is '{}'", column, cell);
}

std::vector<std::string> CsvTable::text(std::string_view column) const {
  const std::size_t index = column_index(column);
  std::vector<std::string> values;
  values.reserve(cells_.size());
  for (const auto& row : cells_) values.push_back(row[index]);
  return values;
}

std::vector<std::optional<double>> CsvTable::optional_numbers(std::string_view column) const {
  const std::vector<std::string> cells = text(column);
  std::vector<std::optional<double>> values;
  values.reserve(cells.size());
  for (std::size_t row = 0; row < cells.size(); ++row) {
    values.push_back(parse_number(cells[row], decimal_commas_));
    if (!values.back() && !says_unknown(cells[row])) {
      throw Error(where(row), fmt::format("{} is '{}'", column, cells[row]), "a finite number");
    }
  }
  return values;
}

std::vector<std::optional<double>> CsvTable::numbers_where_they_are(std::string_view column) const {
  std::vector<std::optional<double>> values;
  values.reserve(cells_.size());
  for (const std::string& cell : text(column)) values.push_back(parse_number(cell, decimal_commas_));
  return values;
}

std::vector<double> CsvTable::numbers(std::string_view column) const {
  std::vector<double> values;
  values.reserve(cells_.size());
  for (const std::optional<double>& value : optional_numbers(column)) {
    if (!value) throw Error(where(values.size()), no_value(column, values.size()), "a finite number");
    values.push_back(*value);
  }
  return values;
}

std::vector<std::optional<std::int64_t>> CsvTable::optional_indices(std::string_view column) const {
  std::vector<std::optional<std::int64_t>> values;
  values.reserve(cells_.size());
  for (const std::optional<double>& value : optional_numbers(column)) {
    if (value && (*value < 0 || *value != std::floor(*value) || *value > 9e15)) {
      throw Error(where(values.size()), fmt::format("{} is {}", column, *value),
                  "a whole number, 0 or greater");
    }
    values.push_back(value ? std::optional(static_cast<std::int64_t>(*value)) : std::nullopt);
  }
  return values;
}

std::vector<std::int64_t> CsvTable::indices(std::string_view column) const {
  std::vector<std::int64_t> values;
  values.reserve(cells_.size());
  for (const std::optional<std::int64_t>& value : optional_indices(column)) {
    if (!value) throw Error(where(values.size()), no_value(column, values.size()), "a whole number");
    values.push_back(*value);
  }
  return values;
}

}  // namespace vo
