#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string_view>

namespace vo {

/// How far a long stage has come, in units of its own (frames, keyframes).
struct Progress {
  std::string_view stage;             ///< what is being done, for people: "reading walk.mp4"
  std::int64_t done = 0;              ///< units finished
  std::optional<std::int64_t> total;  ///< units in all, where known
};

/// Called now and then with how far a stage has come, from the calling thread only. Returning false asks the
/// stage to stop early and keep what it has (the user pressed Ctrl-C on a live camera).
using ProgressCallback = std::function<bool(const Progress&)>;

}  // namespace vo
