#include "run_table.hpp"

#include <algorithm>
#include <string_view>

#include <fmt/format.h>

namespace retrace {

std::string run_table(const vo::Walk& walk, const place::Route& route, const std::string& route_path,
                      const place::Run& run) {
  std::string table = fmt::format("{} on {}\n", walk.source, route_path);
  const auto row = [&](std::string_view name, auto count, std::string_view note) {
    table += fmt::format("  {:<20}{:>7}   {}\n", name, count, note);
  };
  const auto count = [&](auto what) { return std::ranges::count_if(run.matches, what); };
  row("query keyframes", run.matches.size(), fmt::format("of {} frames", walk.frames()));
  row("matched", count([](const place::Match& m) { return m.place.has_value(); }),
      fmt::format("{} on part of a line", count([](const place::Match& m) { return m.partial; })));
  row("accepted", count([](const place::Match& m) { return m.accepted; }),
      run.settings.accept_score
          ? fmt::format("score {:g} or more", *run.settings.accept_score)
          : fmt::format("probability {:g} or more", run.settings.accept_probability.value_or(0)));
  for (const place::Traverse& traverse : route.traverses)
    row("route keyframes", traverse.keyframes.size(), traverse.name);
  return table;
}

}  // namespace retrace
