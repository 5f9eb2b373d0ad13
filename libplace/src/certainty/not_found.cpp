#include "place/certainty/not_found.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace place {

std::optional<std::string> not_found(const std::string& walk, std::span<const Match> matches) {
  constexpr std::size_t kOneIn = 20;
  const auto accepted = static_cast<std::size_t>(std::ranges::count_if(matches, &Match::accepted));
  if (matches.empty() || accepted * kOneIn >= matches.size()) return std::nullopt;
  double best = 0;
  for (const Match& match : matches) best = std::max(best, match.probability.value_or(0));
  const std::string surest = best > 0 ? fmt::format(" (the surest has a probability of {:.2f})", best) : "";
  return fmt::format(
      "{}: {} of {} keyframes accepted{}: another route, or this one in the other direction; if it is the "
      "route, look at both recordings with `retrace doctor`, and try --descriptor, --max-shift-px or another "
      "--search; --accept-probability 0.5 shows less sure matches",
      walk, accepted == 0 ? std::string("none") : fmt::format("only {}", accepted), matches.size(), surest);
}

}  // namespace place
