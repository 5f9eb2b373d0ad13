#include "vo/io/time_unit.hpp"

#include "vo/base/median.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace vo {

TimeUnit time_unit(std::span<const double> time, double path_length, double longest_step_s) {
  if (time.empty()) return {};
  const auto [first, last] = std::ranges::minmax(time);
  if (last >= 1e17) return kNanoseconds;
  if (last >= 1e14) return kMicroseconds;
  std::vector<double> steps;
  for (std::size_t i = 1; i < time.size(); ++i) steps.push_back(std::abs(time[i] - time[i - 1]));
  const double step = steps.empty() ? 0 : median(std::move(steps));
  if (last >= 1e11 && step < 1e6) return kMilliseconds;  // an hour in nanoseconds is 3.6e12

  constexpr double kShortest_s = 0.001, kSlowest_m_s = 0.02;
  for (const TimeUnit& unit : {TimeUnit{}, kMilliseconds, kMicroseconds, kNanoseconds}) {
    const double step_s = step / unit.per_second;
    const bool on_the_way = path_length * unit.per_second >= kSlowest_m_s * (last - first);
    if (path_length > 0 && step_s >= kShortest_s && step_s <= longest_step_s && on_the_way) return unit;
  }
  if (step >= 1e6) return kNanoseconds;
  if (step >= 1e3) return kMicroseconds;
  return step > longest_step_s ? kMilliseconds : TimeUnit{};
}

}  // namespace vo
