#pragma once

#include <cstddef>
#include <cstdint>

#include <vo/motion/alignment_error.hpp>

namespace test_support {

/// Alignment errors that are given: `error_of(i, j)` of frames i and j > i, up to `spans` frames apart, at an
/// even frame rate.
template <typename ErrorOf>
vo::AlignmentErrors made_errors(std::size_t frames, double rate_hz, std::size_t spans, ErrorOf error_of) {
  vo::AlignmentErrors errors;
  errors.by_span.assign(spans, std::vector<vo::Comparison>(frames));
  for (std::size_t s = 1; s <= spans; ++s) {
    for (std::size_t i = 0; i + s < frames; ++i) {
      errors.by_span[s - 1][i] = {.frames = static_cast<std::uint32_t>(s),
                                  .seconds = static_cast<float>(static_cast<double>(s) / rate_hz),
                                  .error = static_cast<float>(error_of(i, i + s))};
    }
  }
  return errors;
}

}  // namespace test_support
