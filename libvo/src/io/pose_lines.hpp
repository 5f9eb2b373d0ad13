#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace vo {

/// A line of a file of numbers.
struct NumberLine {
  std::size_t number = 0;      ///< in the file, from 1
  std::string_view wrong;      ///< the first cell that is no finite number; empty: there is none
  std::vector<double> values;  ///< those before it
};

/// The lines of a file of numbers, and the text that they are in.
struct NumberFile {
  std::string path;
  std::vector<char> bytes;
  std::vector<NumberLine> lines;

  /// "path: line N".
  [[nodiscard]] std::string where(const NumberLine& line) const;
};

/// What a line of another number of cells has: a cell that is none, or how many there are.
std::string problem_of(const NumberLine& line);

/// The lines of a file that are not empty and no comment (`#`), without a first line of names. Cells are
/// separated by white space, commas or semicolons. Throws `vo::Error` if the file cannot be read.
NumberFile read_number_lines(const std::filesystem::path& path, std::string_view expected);

}  // namespace vo
