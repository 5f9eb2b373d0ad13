#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace vo {

/// What `CsvTable::read` does with a row that has more or fewer cells than the header.
enum class UnevenRows {
  kRefuse,   ///< `vo::Error` names its line
  kLeaveOut  ///< it is left out and counted
};

/// A CSV file with a header line, its cells as text.
class CsvTable {
 public:
  /// Reads a file as programs and spreadsheets write it [RFC 4180 and what is done beside it]: one header
  /// line of column names, then rows of as many cells. Cells are separated by commas, semicolons or tabs,
  /// whichever the header has most of; a cell in double or single quotes may hold separators, and its quotes
  /// doubled; an apostrophe that no other closes at the cell's end is one of the cell's.
  /// Spaces around a cell, blank lines, rows of empty cells, lines that begin with `#`, Excel's `sep=;`, byte
  /// order marks and any ends of lines are skipped. A `#` line whose names stand over as many numbers is
  /// the header (EuRoC's files). Throws `vo::Error` naming the file and line if it cannot be read, has no
  /// header, or a row is uneven.
  /// Memory: at most 35 bytes for each of the file's own.
  static CsvTable read(const std::filesystem::path& path, UnevenRows uneven = UnevenRows::kRefuse);

  [[nodiscard]] std::size_t rows() const { return lines_.size(); }
  /// Columns are found by name in small letters or capitals.
  [[nodiscard]] bool has(std::string_view column) const;
  [[nodiscard]] const std::vector<std::string_view>& header() const { return header_; }
  /// Uneven rows left out.
  [[nodiscard]] std::size_t left_out() const { return left_out_; }

  /// The column's cells. Throws `vo::Error` that lists the columns there are, if it is missing.
  [[nodiscard]] std::vector<std::string> text(std::string_view column) const;
  /// The column as finite numbers, with a decimal point, or a decimal comma where that cannot be mistaken
  /// (`parse_number`). Throws `vo::Error` naming file, line, column and cell if one is none.
  [[nodiscard]] std::vector<double> numbers(std::string_view column) const;
  /// The same, with none for a cell that is empty or says so: `NA`, `N/A`, `#N/A`, `NaN`, `null`, `-`.
  [[nodiscard]] std::vector<std::optional<double>> optional_numbers(std::string_view column) const;
  /// The same, with none for any cell that is no finite number.
  [[nodiscard]] std::vector<std::optional<double>> numbers_where_they_are(std::string_view column) const;
  /// The column as whole numbers >= 0. Throws as `numbers`.
  [[nodiscard]] std::vector<std::int64_t> indices(std::string_view column) const;
  /// The same, with none as in `optional_numbers`.
  [[nodiscard]] std::vector<std::optional<std::int64_t>> optional_indices(std::string_view column) const;

  /// "path: line N", for messages on a row.
  [[nodiscard]] std::string where(std::size_t row) const;

 private:
  [[nodiscard]] std::size_t column_index(std::string_view column) const;
  [[nodiscard]] std::string no_value(std::string_view column, std::size_t row) const;  ///< for messages
  [[nodiscard]] std::string_view cell_at(std::size_t row, std::size_t column) const {
    return cells_.at(row * header_.size() + column);
  }
  void find_decimal_mark(char separator);

  std::string path_;
  std::shared_ptr<const std::vector<char>> bytes_;  ///< of the file, in which header and cells lie
  std::vector<std::string_view> header_;
  std::vector<std::string_view> cells_;  ///< row by row
  std::vector<std::size_t> lines_;       ///< of each row
  std::size_t left_out_ = 0;
  bool decimal_commas_ = false;
};

/// A finite number with a decimal point, or with `decimal_commas` a decimal comma as well; none if the text
/// is anything else.
std::optional<double> parse_number(std::string_view text, bool decimal_commas = false);

/// A text as a cell that reads back as the same, but for spaces at its ends, which readers take away, and
/// line breaks, which become spaces: in double quotes where it holds a separator, a quote or a `#`, or begins
/// with an apostrophe [RFC 4180].
std::string csv_cell(std::string_view text);

}  // namespace vo
