#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace vo {

/// A CSV file with a header line, its cells as text.
class CsvTable {
 public:
  /// Reads a file: one header line of column names, then rows of as many cells, separated by commas. Spaces
  /// around a cell, a byte order mark, carriage returns and blank lines are passed over; quoting is not
  /// understood. Throws `vo::Error` naming the file and line if it cannot be read, has no header or a row of
  /// another length.
  static CsvTable read(const std::filesystem::path& path);

  [[nodiscard]] std::size_t rows() const { return cells_.size(); }
  [[nodiscard]] bool has(std::string_view column) const;

  /// The column's cells. Throws `vo::Error` that lists the columns there are, if it is missing.
  [[nodiscard]] std::vector<std::string> text(std::string_view column) const;
  /// The column as finite numbers. Throws `vo::Error` naming file, line, column and cell if one is none.
  [[nodiscard]] std::vector<double> numbers(std::string_view column) const;
  /// The same, with none for an empty cell.
  [[nodiscard]] std::vector<std::optional<double>> optional_numbers(std::string_view column) const;
  /// The column as whole numbers >= 0. Throws as `numbers`.
  [[nodiscard]] std::vector<std::int64_t> indices(std::string_view column) const;

  /// "path: line N", for messages on a row.
  [[nodiscard]] std::string where(std::size_t row) const;

 private:
  [[nodiscard]] std::size_t column_index(std::string_view column) const;

  std::string path_;
  std::vector<std::string> header_;
  std::vector<std::vector<std::string>> cells_;
  std::vector<std::size_t> lines_;
};

}  // namespace vo
