#include "vo/base/error.hpp"
#include "vo/io/csv_columns.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace vo {
namespace {

std::string_view trim(std::string_view text) {
  constexpr std::string_view kSpace = " \t\r";
  const std::size_t begin = text.find_first_not_of(kSpace);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(kSpace) - begin + 1);
}

std::vector<std::string> split(std::string_view line) {
  std::vector<std::string> cells;
  for (std::size_t begin = 0;;) {
    const std::size_t comma = line.find(',', begin);
    cells.emplace_back(trim(line.substr(begin, comma - begin)));
    if (comma == std::string_view::npos) return cells;
    begin = comma + 1;
  }
}

}  // namespace

std::optional<double> csv_number(std::string_view cell) {
  double value = 0;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  if (error != std::errc{} || end != cell.data() + cell.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

CsvTable CsvTable::read(const std::filesystem::path& path) {
  CsvTable table;
  table.path_ = path.string();
  if (!std::filesystem::exists(path)) throw Error(table.path_, "does not exist", "a CSV file");
  std::ifstream file(path);
  if (!file || std::filesystem::is_directory(path)) throw Error(table.path_, "cannot be read", "a CSV file");

  std::string line;
  for (std::size_t number = 1; std::getline(file, line); ++number) {
    std::string_view content = line;
    constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
    if (number == 1 && content.starts_with(kByteOrderMark)) content.remove_prefix(kByteOrderMark.size());
    if (trim(content).empty()) continue;
    std::vector<std::string> cells = split(content);
    if (table.header_.empty()) {
      table.header_ = std::move(cells);
      continue;
    }
    if (cells.size() != table.header_.size()) {
      throw Error(fmt::format("{}: line {}", table.path_, number), fmt::format("has {} cells", cells.size()),
                  fmt::format("{} as in the header", table.header_.size()));
    }
    table.cells_.push_back(std::move(cells));
    table.lines_.push_back(number);
  }
  if (file.bad()) throw Error(table.path_, "cannot be read to its end");
  if (table.header_.empty()) throw Error(table.path_, "is empty", "a CSV file with a header line");
  return table;
}

bool CsvTable::has(std::string_view column) const {
  return std::ranges::find(header_, column) != header_.end();
}

std::size_t CsvTable::column_index(std::string_view column) const {
  const auto found = std::ranges::find(header_, column);
  if (found == header_.end()) {
    throw Error(path_, fmt::format("has no column '{}'", column),
                fmt::format("it among those there are ({})", fmt::join(header_, ", ")));
  }
  return static_cast<std::size_t>(found - header_.begin());
}

std::string CsvTable::where(std::size_t row) const {
  return fmt::format("{}: line {}", path_, lines_.at(row));
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
    values.push_back(csv_number(cells[row]));
    if (!values.back() && !cells[row].empty()) {
      throw Error(where(row), fmt::format("{} is '{}'", column, cells[row]), "a finite number");
    }
  }
  return values;
}

std::vector<double> CsvTable::numbers(std::string_view column) const {
  std::vector<double> values;
  values.reserve(cells_.size());
  for (const std::optional<double>& value : optional_numbers(column)) {
    if (!value) throw Error(where(values.size()), fmt::format("{} is empty", column), "a finite number");
    values.push_back(*value);
  }
  return values;
}

std::vector<std::int64_t> CsvTable::indices(std::string_view column) const {
  std::vector<std::int64_t> values;
  values.reserve(cells_.size());
  for (const double value : numbers(column)) {
    if (value < 0 || value != std::floor(value) || value > 9e15) {
      throw Error(where(values.size()), fmt::format("{} is {}", column, value),
                  "a whole number, 0 or greater");
    }
    values.push_back(static_cast<std::int64_t>(value));
  }
  return values;
}

}  // namespace vo
