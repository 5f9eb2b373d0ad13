#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace vo {

/// Seconds since 1970 (UTC, without leap seconds) of a time as ISO 8601 and XML Schema write it:
/// `2024-05-31T12:00:00`, with a point or a comma before any fraction, and `T` or a space before the hour.
/// After it `Z`, `+02:00`, `+0200`, `+02`, or nothing, which means UTC. None if the text is anything else.
std::optional<double> parse_iso_time(std::string_view text);

/// The time as `2024-05-31T12:00:00.000Z`, rounded to milliseconds. `std::invalid_argument` outside the years
/// 1 to 9999.
std::string iso_time(double utc_s);

}  // namespace vo
