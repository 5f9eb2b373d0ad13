#include "vo/base/iso_time.hpp"

#include <charconv>
#include <chrono>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

namespace vo {
namespace {

// Seconds since 1970 of the beginnings of the years 1 and 10000: what `iso_time` can write is what can be
// read.
constexpr double kYear1 = -62135596800, kYear10000 = 253402300800;

bool can_be_written(double utc_s) {
  return utc_s >= kYear1 && utc_s < kYear10000 - 1;
}

/// Takes pieces off the front of a text.
class Scanner {
 public:
  explicit Scanner(std::string_view text) : rest_(text) {}

  [[nodiscard]] bool done() const { return rest_.empty(); }

  bool take(char c) {
    if (!rest_.starts_with(c)) return false;
    rest_.remove_prefix(1);
    return true;
  }

  /// A whole number of exactly so many digits.
  std::optional<int> digits(std::size_t count) {
    int value = 0;
    if (rest_.size() < count) return std::nullopt;
    const auto [end, error] = std::from_chars(rest_.data(), rest_.data() + count, value);
    if (error != std::errc{} || end != rest_.data() + count || rest_.front() == '-') return std::nullopt;
    rest_.remove_prefix(count);
    return value;
  }

  /// The fraction whose digits follow.
  double fraction() {
    double value = 0, unit = 1;
    while (!rest_.empty() && rest_.front() >= '0' && rest_.front() <= '9') {
      unit /= 10;
      value += unit * (rest_.front() - '0');
      rest_.remove_prefix(1);
    }
    return value;
  }

 private:
  std::string_view rest_;
};

/// Seconds east of Greenwich of `Z`, `+02:00`, `+0200`, `+02` or nothing.
std::optional<int> zone_s(Scanner& scanner) {
  if (scanner.done() || scanner.take('Z') || scanner.take('z')) return 0;
  const bool east = scanner.take('+');
  if (!east && !scanner.take('-')) return std::nullopt;
  const std::optional<int> hours = scanner.digits(2);
  if (!hours || *hours > 14) return std::nullopt;
  int minutes = 0;
  if (!scanner.done()) {
    scanner.take(':');
    const std::optional<int> given = scanner.digits(2);
    if (!given || *given > 59) return std::nullopt;
    minutes = *given;
  }
  return (east ? 60 : -60) * (60 * *hours + minutes);
}

}  // namespace

std::optional<double> parse_iso_time(std::string_view text) {
  Scanner scanner(text);
  const auto year = scanner.digits(4);
  if (!year || !scanner.take('-')) return std::nullopt;
  const auto month = scanner.digits(2);
  if (!month || !scanner.take('-')) return std::nullopt;
  const auto day = scanner.digits(2);
  if (!day || (!scanner.take('T') && !scanner.take('t') && !scanner.take(' '))) return std::nullopt;
  const auto hour = scanner.digits(2);
  if (!hour || !scanner.take(':')) return std::nullopt;
  const auto minute = scanner.digits(2);
  if (!minute || !scanner.take(':')) return std::nullopt;
  const auto second = scanner.digits(2);
  if (!second || *hour > 24 || *minute > 59 || *second > 60) return std::nullopt;
  const double fraction = scanner.take('.') || scanner.take(',') ? scanner.fraction() : 0;
  const std::optional<int> zone = zone_s(scanner);
  const std::chrono::year_month_day date(std::chrono::year(*year),
                                         std::chrono::month(static_cast<unsigned>(*month)),
                                         std::chrono::day(static_cast<unsigned>(*day)));
  if (!zone || !scanner.done() || !date.ok()) return std::nullopt;
  const auto days = std::chrono::sys_days(date).time_since_epoch().count();
  const double utc_s =
      86400.0 * static_cast<double>(days) + 3600 * *hour + 60 * *minute + *second - *zone + fraction;
  return can_be_written(utc_s) ? std::optional(utc_s) : std::nullopt;
}

std::string iso_time(double utc_s) {
  if (!can_be_written(utc_s)) throw std::invalid_argument("iso_time: a time in the years 1 to 9999 expected");
  const auto all_ms = std::chrono::milliseconds(std::llround(1000 * utc_s));
  const auto day = std::chrono::floor<std::chrono::days>(all_ms);
  const std::chrono::year_month_day date{std::chrono::sys_days(day)};
  const std::chrono::hh_mm_ss time(all_ms - day);
  return fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:02}.{:03}Z", static_cast<int>(date.year()),
                     static_cast<unsigned>(date.month()), static_cast<unsigned>(date.day()),
                     time.hours().count(), time.minutes().count(), time.seconds().count(),
                     time.subseconds().count());
}

}  // namespace vo
