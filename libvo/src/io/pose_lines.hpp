#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace vo {

/// A line of a file of numbers, and where it is.
struct NumberLine {
  std::string where;                   ///< "path: line N"
  std::optional<std::string> problem;  ///< why it is no line of finite numbers
  std::vector<double> values;          ///< those before the first that is none
};

/// The lines of a file of numbers that are not empty and no comment (`#`), without a first line of names.
/// Cells are separated by white space, commas or semicolons. Throws `vo::Error` if the file cannot be read.
std::vector<NumberLine> read_number_lines(const std::filesystem::path& path, std::string_view expected);

}  // namespace vo
