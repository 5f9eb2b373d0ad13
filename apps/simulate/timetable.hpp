#pragma once

#include "gait.hpp"
#include "options.hpp"

#include <cstdint>
#include <vector>

namespace simulate {

/// When the walker is where: distance walked, speed and steps taken over time.
class Timetable {
 public:
  struct Entry {
    double walked_m = 0;
    double speed_mps = 0;
    double steps = 0;  ///< the fraction is how far into the next step
  };

  /// Walks `walked_m` metres. `steady` keeps the walker's own speed, `run` jogs; `slow-fast` is a stroll that
  /// becomes a jog half-way and `fast-slow` its opposite (SSS 4.1, Kelvin Grove); `varied` changes its speed
  /// every few metres, `stops` stands now and then, also at both ends. Speed changes at 0.8 m/s2 at most.
  Timetable(Speed speed, double walked_m, const Walker& walker, std::uint64_t seed);

  [[nodiscard]] double duration_s() const;
  /// Linear between entries; the end points beyond them.
  [[nodiscard]] Entry at(double time_s) const;

 private:
  std::vector<Entry> entries_;  // every kTick_s
};

}  // namespace simulate
