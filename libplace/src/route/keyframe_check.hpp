#pragma once

#include "place/route/route.hpp"

#include <span>
#include <string_view>

namespace place {

/// What keyframes that were read from a file cannot be, in words; empty if nothing: numbers that are none,
/// frames that do not increase, times that go back, a gap before the first.
std::string_view problem_of(std::span<const Keyframe> keyframes);

/// The largest side of a recording's picture that is one, px.
inline constexpr std::int64_t kLargestPicture = 1 << 20;

}  // namespace place
