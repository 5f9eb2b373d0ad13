#include "memory_limit.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string_view>
#include <sys/resource.h>

#include <vo/base/error.hpp>

namespace retrace {

std::size_t bytes_of(const std::string& text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const std::string_view unit(end, static_cast<std::size_t>(text.data() + text.size() - end));
  const int shift = unit == "K" ? 10 : unit == "M" ? 20 : unit == "G" ? 30 : unit == "T" ? 40 : 0;
  constexpr double kMost = 1e15;
  if (error != std::errc() || shift == 0 || !(value > 0) || std::ldexp(value, shift) > kMost)
    throw vo::Error("--memory " + text, "is no amount of memory", "a number with K, M, G or T, as 2G");
  return static_cast<std::size_t>(std::ldexp(value, shift));
}

void limit_memory(std::size_t bytes) {
  rlimit limit{};
  if (getrlimit(RLIMIT_DATA, &limit) != 0) return;
  limit.rlim_cur = std::min<rlim_t>(limit.rlim_max, bytes);
  setrlimit(RLIMIT_DATA, &limit);
}

}  // namespace retrace
