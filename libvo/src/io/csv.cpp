#include "vo/io/csv.hpp"

#include "vo/base/error.hpp"
#include "vo/io/text_file.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <span>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace vo {
namespace {

/// Where a single quote closes the cell that began with one: no other follows it, and the cell ends there.
/// `npos` if none does, as in "'t Hoekje".
std::size_t closing_quote(std::string_view line, std::size_t begin, char separator) {
  for (std::size_t i = begin; i < line.size(); ++i) {
    if (line[i] != '\'') continue;
    if (i + 1 < line.size() && line[i + 1] == '\'') {
      ++i;
      continue;
    }
    const std::size_t next = line.find_first_not_of(separator == '\t' ? " \r" : " \t\r", i + 1);
    if (next == std::string_view::npos || line[next] == separator) return i;
  }
  return std::string_view::npos;
}

/// Appends the cells of a line, without the quotes around them. Quotes are taken out in place: a cell is
/// never longer than what is written for it.
void split(std::span<char> line, char separator, std::vector<std::string_view>& cells) {
  std::size_t begin = 0, end = 0;    // of a cell
  bool blank = true, single = true;  // the cell so far; whether single quotes may still close
  char quote = 0;                    // that the cell is in
  std::size_t closes = 0;            // where a single one does
  const auto put = [&](char c) {
    line[end++] = c;
    blank = blank && trimmed({&c, 1}).empty();
  };
  const auto finish = [&] {
    cells.push_back(trimmed({line.data() + begin, end - begin}));
    begin = end;
    blank = true;
  };
  const auto opens_single_quote = [&](std::size_t i) {
    closes = closing_quote({line.data(), line.size()}, i + 1, separator);
    single = closes != std::string_view::npos;  // later ones close no sooner
    return single;
  };
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (quote != 0 && c == quote && i + 1 < line.size() && line[i + 1] == quote) {
      put(line[++i]);  // a doubled quote is one of the cell's
    } else if (quote != 0) {
      if (c == quote && (quote == '"' || i == closes)) {
        quote = 0;
      } else {
        put(c);
      }
    } else if (c == '"' && blank) {
      quote = c;
    } else if (c == '\'' && blank && single && opens_single_quote(i)) {
      quote = c;
    } else if (c == separator) {
      finish();
    } else {
      put(c);
    }
  }
  finish();
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

/// Whether a `#` line is the header of the rows after it: names over as many numbers.
bool heads(std::string comment, std::string next_line) {
  const char separator = separator_of(comment);
  std::vector<std::string_view> names, values;
  split(comment, separator, names);
  split(next_line, separator, values);
  const auto is_number = [](std::string_view cell) { return parse_number(cell, true).has_value(); };
  return names.size() > 1 && names.size() == values.size() && std::ranges::none_of(names, is_number) &&
         std::ranges::all_of(values, is_number);
}

/// The lines of a file that say something, the header first, which `separator` is that of.
std::vector<TextLine> lines_from_header(TextFile& file, const std::filesystem::path& path, char& separator) {
  std::vector<TextLine> lines = std::move(file.lines);
  std::erase_if(lines, [](const TextLine& line) { return trimmed(line.text).empty(); });
  std::size_t first = 0;
  std::optional<char> said;
  for (; first < lines.size(); ++first) {
    const std::string_view text = trimmed(lines[first].text);
    if (text.starts_with("sep=") && text.size() <= 5) {
      said = text.size() == 5 ? text[4] : '\t';  // whose tab was trimmed
    } else if (!text.starts_with('#')) {
      break;
    } else if (first + 1 < lines.size() &&
               heads(std::string(text.substr(1)), std::string(lines[first + 1].text))) {
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
  TextFile file = read_text_file(path, "a CSV file");
  const std::vector<TextLine> lines = lines_from_header(file, path, separator);
  const auto line_of = [&](const TextLine& line) {
    return std::span(file.bytes)
        .subspan(static_cast<std::size_t>(line.text.data() - file.bytes.data()), line.text.size());
  };
  const auto cells_in = [&](std::string_view text) {
    return static_cast<std::size_t>(std::ranges::count(text, separator)) + 1;
  };
  table.header_.reserve(cells_in(lines[0].text));
  split(line_of(lines[0]), separator, table.header_);
  std::string_view& name = table.header_.front();  // EuRoC's `#` within a spreadsheet's quotes
  if (name.starts_with('#')) name = trimmed(name.substr(1));
  const std::size_t columns = table.header_.size();
  std::size_t most = 0;
  for (std::size_t i = 1; i < lines.size(); ++i) most += cells_in(lines[i].text);
  table.cells_.reserve(most);
  table.lines_.reserve(lines.size() - 1);
  for (std::size_t i = 1; i < lines.size(); ++i) {
    if (trimmed(lines[i].text).starts_with('#')) continue;
    const std::size_t before = table.cells_.size();
    split(line_of(lines[i]), separator, table.cells_);
    const std::span row = std::span(table.cells_).subspan(before);
    const bool empty = std::ranges::all_of(row, [](std::string_view cell) { return cell.empty(); });
    if (row.size() == columns && !empty) {
      table.lines_.push_back(lines[i].number);
      continue;
    }
    if (!empty && uneven == UnevenRows::kRefuse) {
      throw Error(fmt::format("{}: line {}", table.path_, lines[i].number),
                  fmt::format("has {} cells", row.size()), fmt::format("{} as in the header", columns));
    }
    table.left_out_ += empty ? 0 : 1;
    table.cells_.resize(before);
  }
  table.bytes_ = std::make_shared<const std::vector<char>>(std::move(file.bytes));
  table.find_decimal_mark(separator);
  return table;
}

void CsvTable::find_decimal_mark(char separator) {
  // Where commas do not separate, one in a number is its decimal mark. Where they do, a quoted "1,234" may be
  // a thousand: only other groups than of three digits say that the file has decimal commas.
  decimal_commas_ = separator != ',';
  for (std::size_t i = 0; i < cells_.size() && !decimal_commas_; ++i) {
    const std::size_t comma = cells_[i].rfind(',');
    decimal_commas_ =
        comma != std::string_view::npos && cells_[i].size() - comma - 1 != 3 && parse_number(cells_[i], true);
  }
}

bool CsvTable::has(std::string_view column) const {
  return std::ranges::any_of(header_, [&](std::string_view name) { return same_name(name, column); });
}

std::size_t CsvTable::column_index(std::string_view column) const {
  const auto found =
      std::ranges::find_if(header_, [&](std::string_view name) { return same_name(name, column); });
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
  const std::string_view cell = cell_at(row, column_index(column));
  return cell.empty() ? fmt::format("{} is empty", column)
                      : fmt::format("{} is '{}'", column, printable(cell));
}

std::vector<std::string> CsvTable::text(std::string_view column) const {
  const std::size_t index = column_index(column);
  std::vector<std::string> values;
  values.reserve(rows());
  for (std::size_t row = 0; row < rows(); ++row) values.emplace_back(cell_at(row, index));
  return values;
}

std::vector<std::optional<double>> CsvTable::optional_numbers(std::string_view column) const {
  const std::size_t index = column_index(column);
  std::vector<std::optional<double>> values;
  values.reserve(rows());
  for (std::size_t row = 0; row < rows(); ++row) {
    const std::string_view cell = cell_at(row, index);
    values.push_back(parse_number(cell, decimal_commas_));
    if (!values.back() && !says_unknown(cell))
      throw Error(where(row), fmt::format("{} is '{}'", column, printable(cell)), "a finite number");
  }
  return values;
}

std::vector<std::optional<double>> CsvTable::numbers_where_they_are(std::string_view column) const {
  const std::size_t index = column_index(column);
  std::vector<std::optional<double>> values;
  values.reserve(rows());
  for (std::size_t row = 0; row < rows(); ++row)
    values.push_back(parse_number(cell_at(row, index), decimal_commas_));
  return values;
}

std::vector<double> CsvTable::numbers(std::string_view column) const {
  std::vector<double> values;
  values.reserve(rows());
  for (const std::optional<double>& value : optional_numbers(column)) {
    if (!value) throw Error(where(values.size()), no_value(column, values.size()), "a finite number");
    values.push_back(*value);
  }
  return values;
}

std::vector<std::optional<std::int64_t>> CsvTable::optional_indices(std::string_view column) const {
  std::vector<std::optional<std::int64_t>> values;
  values.reserve(rows());
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
  values.reserve(rows());
  for (const std::optional<std::int64_t>& value : optional_indices(column)) {
    if (!value) throw Error(where(values.size()), no_value(column, values.size()), "a whole number");
    values.push_back(*value);
  }
  return values;
}

std::string csv_cell(std::string_view text) {
  const bool plain = text.find_first_of(",;\t\"#\r\n") == std::string_view::npos && !text.starts_with(' ') &&
                     !text.ends_with(' ') && !text.starts_with('\'');
  if (plain) return std::string(text);
  std::string cell = "\"";
  for (const char c : text) cell.append(c == '"' ? 2 : 1, c == '\n' || c == '\r' ? ' ' : c);
  return cell + '"';
}

}  // namespace vo
