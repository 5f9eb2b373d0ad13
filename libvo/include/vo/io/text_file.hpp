#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace vo {

/// One line of a text file.
struct TextLine {
  std::size_t number = 0;  ///< in the file, from 1
  std::string_view text;   ///< without the end of the line; valid as long as the file's bytes
};

/// A text file: at most 30 bytes of memory for each of its own.
struct TextFile {
  std::vector<char> bytes;  ///< in UTF-8; a vector, whose contents stay where they are when it is moved
  std::vector<TextLine> lines;
};

/// Reads a text file as people's programs write it: UTF-8, or UTF-16 (spreadsheets' "Unicode text"), with or
/// without a byte order mark; lines ended by LF, CR LF or CR. `expected` says in an error what the
/// file should have been. Throws `vo::Error` naming the file if it is missing, a folder, or cannot be read.
TextFile read_text_file(const std::filesystem::path& path, std::string_view expected);

/// The text without white space at both ends.
std::string_view trimmed(std::string_view text);

/// The text without the quotes around it, single or double, if it has both.
std::string_view without_quotes(std::string_view text);

/// The beginning of what a file holds, for messages: it may be no text at all.
std::string printable(std::string_view text);

}  // namespace vo
