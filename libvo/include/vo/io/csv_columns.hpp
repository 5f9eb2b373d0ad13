#pragma once

#include "vo/base/error.hpp"
#include "vo/io/csv.hpp"

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace vo {

/// A column of a CSV file whose rows are a struct: one table of these both writes and reads the file.
template <typename Row>
struct CsvColumn {
  const char* name;
  std::string (*write)(const Row&);  ///< the cell
  /// Puts a cell into the row; false if it is not of the kind that `expected` says. Null: not read back.
  bool (*read)(Row&, std::string_view cell) = nullptr;
  const char* expected = "";
  bool required = true;  ///< to be there when the file is read
};

/// A file's text: the header, and a line for each row.
template <typename Row>
std::string to_csv(std::span<const Row> rows, std::span<const CsvColumn<Row>> columns) {
  std::string text;
  for (const CsvColumn<Row>& column : columns) {
    if (&column != &columns.front()) text += ',';
    text += column.name;
  }
  text += '\n';
  for (const Row& row : rows) {
    for (const CsvColumn<Row>& column : columns) {
      if (&column != &columns.front()) text += ',';
      text += column.write(row);
    }
    text += '\n';
  }
  return text;
}

/// Reads it back. Throws `vo::Error` naming file and line for a required column that is missing or a cell of
/// another kind.
template <typename Row>
std::vector<Row> read_csv(const std::filesystem::path& path, std::span<const CsvColumn<Row>> columns) {
  const CsvTable table = CsvTable::read(path);
  std::vector<Row> rows(table.rows());
  for (const CsvColumn<Row>& column : columns) {
    if (column.read == nullptr || (!column.required && !table.has(column.name))) continue;
    const std::vector<std::string> cells = table.text(column.name);
    for (std::size_t i = 0; i < rows.size(); ++i) {
      if (!column.read(rows[i], cells[i]))
        throw Error(table.where(i), std::string(column.name) + " is '" + cells[i] + "'", column.expected);
    }
  }
  return rows;
}

}  // namespace vo
