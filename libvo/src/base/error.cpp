#include "vo/base/error.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace vo {
namespace {

std::string one_line(std::string_view where, std::string_view what, std::string_view expectation) {
  std::string text = fmt::format("{}: {}", where, what);
  if (!expectation.empty()) text += fmt::format("; expected {}", expectation);
  std::ranges::replace_if(
      text, [](char c) { return c == '\n' || c == '\r'; }, ' ');
  return text;
}

}  // namespace

Error::Error(std::string_view where, std::string_view what, std::string_view expectation)
    : std::runtime_error(one_line(where, what, expectation)) {}

}  // namespace vo
