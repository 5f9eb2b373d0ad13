#pragma once

#include <string>
#include <string_view>

namespace test_support {

/// The text with every `what` in it replaced.
inline std::string replaced(std::string_view text, std::string_view what, std::string_view by) {
  std::string result;
  std::size_t begin = 0;
  for (std::size_t at = text.find(what); at != std::string_view::npos; at = text.find(what, begin)) {
    result.append(text.substr(begin, at - begin)).append(by);
    begin = at + what.size();
  }
  return result.append(text.substr(begin));
}

}  // namespace test_support
