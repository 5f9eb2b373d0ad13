#include "timetable.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <vo/base/rng.hpp>

namespace simulate {
namespace {

constexpr double kTick_s = 0.005;
constexpr double kAcceleration_mps2 = 0.8;  // an unhurried start: up to walking speed in two or three steps
constexpr double kStroll_mps = 0.95;
constexpr double kJog_mps = 2.2;  // just beyond the change from walking to running, at about 2 m/s
constexpr double kRun_mps = 2.7;
constexpr double kCreep_mps = 0.1;  // the last centimetres before a stop

// The speed wanted from a place on, or a stand there.
struct Order {
  double from_m;
  double speed_mps;
  double stand_s;
};

std::vector<Order> orders_for(Speed speed, double walked_m, const Walker& walker, vo::Rng rng) {
  const double own = walker.preferred_speed_mps;
  std::vector<Order> orders;
  switch (speed) {
    case Speed::kSteady:
      return {{0, own, 0}};
    case Speed::kRun:
      return {{0, kRun_mps, 0}};
    case Speed::kSlowFast:
      return {{0, kStroll_mps, 0}, {walked_m / 2, kJog_mps, 0}};
    case Speed::kFastSlow:
      return {{0, kJog_mps, 0}, {walked_m / 2, kStroll_mps, 0}};
    case Speed::kVaried:
      for (double at = 0; at < walked_m; at += rng.uniform(6, 18))
        orders.push_back({at, rng.uniform(0.8, 2.2), 0});
      return orders;
    case Speed::kStops:
      for (double at = 0; at < walked_m; at += rng.uniform(12, 30))
        orders.push_back({at, own, rng.uniform(2, 5)});
      orders.push_back({walked_m, own, 2});
      return orders;
  }
  throw std::invalid_argument("Timetable: unknown speed");
}

}  // namespace

Timetable::Timetable(Speed speed, double walked_m, const Walker& walker, std::uint64_t seed) {
  if (!(walked_m > 0)) throw std::invalid_argument("Timetable: a distance above 0 expected");
  const std::vector<Order> orders = orders_for(speed, walked_m, walker, vo::Rng(seed));
  std::size_t next = 0;
  double wanted_mps = 0, stand_s = 0;
  Entry now{0, orders.front().stand_s > 0 ? 0.0 : orders.front().speed_mps, 0};
  entries_.push_back(now);
  while (now.walked_m < walked_m || stand_s > 0 || next < orders.size()) {
    if (stand_s <= 0 && next < orders.size() && now.walked_m >= orders[next].from_m) {
      wanted_mps = orders[next].speed_mps;
      stand_s = orders[next].stand_s;
      ++next;
    }
    if (now.walked_m >= walked_m && stand_s <= 0) break;
    double target = wanted_mps;
    if (stand_s > 0) {
      target = 0;
      stand_s -= kTick_s;
      now.speed_mps = 0;
    } else if (next < orders.size() && orders[next].stand_s > 0) {
      const double left_m = std::max(0.0, orders[next].from_m - now.walked_m);
      target = std::min(target, std::max(kCreep_mps, std::sqrt(2 * kAcceleration_mps2 * left_m)));
    }
    const double change = kAcceleration_mps2 * kTick_s;
    now.speed_mps += std::clamp(target - now.speed_mps, -change, change);
    const double moved_m = std::min(now.speed_mps * kTick_s, walked_m - now.walked_m);
    now.walked_m = moved_m < now.speed_mps * kTick_s ? walked_m : now.walked_m + moved_m;
    now.steps += moved_m / (step_length_m(walker, now.speed_mps) *
                            step_variation(walker, static_cast<std::int64_t>(now.steps)));
    entries_.push_back(now);
  }
}

double Timetable::duration_s() const {
  return static_cast<double>(entries_.size() - 1) * kTick_s;
}

Timetable::Entry Timetable::at(double time_s) const {
  const double tick = std::clamp(time_s / kTick_s, 0.0, static_cast<double>(entries_.size() - 1));
  const auto before = static_cast<std::size_t>(tick);
  const std::size_t after = std::min(before + 1, entries_.size() - 1);
  const double t = tick - static_cast<double>(before);
  const Entry &a = entries_[before], &b = entries_[after];
  return {std::lerp(a.walked_m, b.walked_m, t), std::lerp(a.speed_mps, b.speed_mps, t),
          std::lerp(a.steps, b.steps, t)};
}

}  // namespace simulate
