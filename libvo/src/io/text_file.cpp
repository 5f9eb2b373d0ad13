#include "vo/io/text_file.hpp"

#include "vo/base/error.hpp"

#include <algorithm>
#include <fstream>

namespace vo {
namespace {

void append_utf8(std::vector<char>& text, char32_t code) {
  const auto put = [&](char32_t byte) {
    text.push_back(static_cast<char>(static_cast<unsigned char>(byte)));
  };
  if (code < 0x80) {
    put(code);
  } else if (code < 0x800) {
    put(0xC0 | (code >> 6));
    put(0x80 | (code & 0x3F));
  } else if (code < 0x10000) {
    put(0xE0 | (code >> 12));
    put(0x80 | ((code >> 6) & 0x3F));
    put(0x80 | (code & 0x3F));
  } else {
    put(0xF0 | (code >> 18));
    put(0x80 | ((code >> 12) & 0x3F));
    put(0x80 | ((code >> 6) & 0x3F));
    put(0x80 | (code & 0x3F));
  }
}

/// UTF-8 of UTF-16; half a surrogate pair becomes a question mark.
std::vector<char> from_utf16(std::string_view bytes, bool big_endian) {
  std::vector<char> text;
  text.reserve(bytes.size() + bytes.size() / 2);  // three bytes for two at most
  const auto unit = [&](std::size_t i) {
    const auto a = static_cast<unsigned char>(bytes[i]), b = static_cast<unsigned char>(bytes[i + 1]);
    return static_cast<char32_t>(big_endian ? a << 8 | b : b << 8 | a);
  };
  for (std::size_t i = 0; i + 1 < bytes.size(); i += 2) {
    char32_t code = unit(i);
    const bool first_half = code >= 0xD800 && code < 0xDC00, second_half = code >= 0xDC00 && code < 0xE000;
    const char32_t next = first_half && i + 3 < bytes.size() ? unit(i + 2) : 0;
    if (next >= 0xDC00 && next < 0xE000) {
      code = 0x10000 + ((code - 0xD800) << 10) + (next - 0xDC00);
      i += 2;
    } else if (first_half || second_half) {
      code = U'?';
    }
    append_utf8(text, code);
  }
  return text;
}

/// True if every other of the first bytes is zero, from `first` on, and no other is: UTF-16 of Latin text
/// without a byte order mark.
bool every_other_is_zero(std::string_view bytes, std::size_t first) {
  constexpr std::size_t kLookedAt = 64;
  const std::string_view begin = bytes.substr(0, std::min(kLookedAt, bytes.size() / 2 * 2));
  for (std::size_t i = 0; i < begin.size(); ++i)
    if ((begin[i] == '\0') != (i % 2 == first)) return false;
  return begin.size() >= 4;
}

/// The text of a file in UTF-8, by its byte order mark.
std::vector<char> decoded(std::vector<char> bytes) {
  const std::string_view all(bytes.data(), bytes.size());
  if (all.starts_with("\xEF\xBB\xBF")) {
    bytes.erase(bytes.begin(), bytes.begin() + 3);
    return bytes;
  }
  if (all.starts_with("\xFF\xFE")) return from_utf16(all.substr(2), false);
  if (all.starts_with("\xFE\xFF")) return from_utf16(all.substr(2), true);
  for (const std::size_t zero : {1U, 0U})
    if (every_other_is_zero(all, zero)) return from_utf16(all, zero == 0);
  return bytes;
}

/// The bytes of a stream of any kind, which may not say beforehand how many there are.
std::vector<char> bytes_of(std::istream& stream) {
  std::vector<char> bytes;
  constexpr std::size_t kPiece = 1U << 16U;
  for (std::size_t read = 0;;) {
    bytes.resize(read + std::max(kPiece, read / 2));
    stream.read(bytes.data() + read, static_cast<std::streamsize>(bytes.size() - read));
    read += static_cast<std::size_t>(stream.gcount());
    if (stream) continue;
    bytes.resize(read);
    return bytes;
  }
}

}  // namespace

TextFile read_text_file(const std::filesystem::path& path, std::string_view expected) {
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) throw Error(path.string(), "does not exist", expected);
  std::ifstream file(path, std::ios::binary);
  if (!file || std::filesystem::is_directory(path, ignored))
    throw Error(path.string(), "cannot be read", expected);
  std::vector<char> bytes = bytes_of(file);
  if (file.bad()) throw Error(path.string(), "cannot be read to its end");
  TextFile read{.bytes = decoded(std::move(bytes)), .lines = {}};
  const std::string_view text(read.bytes.data(), read.bytes.size());
  read.lines.reserve(static_cast<std::size_t>(
      std::ranges::count_if(text, [](char c) { return c == '\r' || c == '\n'; }) + 1));
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find_first_of("\r\n", begin), text.size());
    read.lines.push_back({read.lines.size() + 1, text.substr(begin, end - begin)});
    const bool two = end + 1 < text.size() && text[end] == '\r' && text[end + 1] == '\n';
    begin = end + (two ? 2 : 1);
  }
  return read;
}

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kSpace = " \t\r\n";
  const std::size_t begin = text.find_first_not_of(kSpace);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(kSpace) - begin + 1);
}

std::string_view without_quotes(std::string_view text) {
  const bool quoted =
      text.size() >= 2 && (text.front() == '"' || text.front() == '\'') && text.back() == text.front();
  return quoted ? text.substr(1, text.size() - 2) : text;
}

std::string printable(std::string_view text) {
  constexpr std::size_t kMost = 40;
  std::string shown(text.substr(0, kMost));
  for (char& c : shown) c = c >= ' ' && c <= '~' ? c : '?';
  return shown + (text.size() > kMost ? "..." : "");
}

}  // namespace vo
