// What the files of a run say of its matches: matches.csv, config.toml and summary.json, between lines of %%.
#include "fuzz.hpp"
#include "run_summary.hpp"
#include "settings_file.hpp"

#include <fstream>

#include <place/match/match_io.hpp>
#include <place/match/reference_timeline.hpp>
#include <place/route/route.hpp>

namespace {

/// A route that the seeds' matches are on.
place::Route route_of_three() {
  place::Route route;
  for (const char* name : {"day", "night"}) {
    place::Traverse& traverse = route.traverses.emplace_back();
    traverse.name = name;
    traverse.frames = 30;
    for (int k = 0; k < 3; ++k)
      traverse.keyframes.push_back({.frame = 10 * k, .time_s = 0.4 * k, .displacement = 1.0 * k});
  }
  return route;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto parts = fuzz::parts({data, size}, 3);
  const auto file = fuzz::write("matches.csv", parts[0]);
  const auto config = fuzz::write("config.toml", parts[1]);
  fuzz::write("summary.json", parts[2]);
  static const place::Route route = route_of_three();
  const auto read = [&] {
    std::vector<place::Match> matches = place::read_matches(file);
    const retrace::RunSummary summary = retrace::read_run_summary(fuzz::folder());
    const std::vector<std::size_t> gaps = retrace::gaps_of(summary, matches);
    std::ofstream(file) << place::to_csv(matches);
    place::read_matches(file);  // what was read can be written
    place::locate(matches, route);
    constexpr std::size_t kFrames = 1000;
    const auto frames = static_cast<std::size_t>(matches.back().query_frame) + 1;
    if (frames <= kFrames) place::reference_timeline(route, matches, frames, {}, gaps);
  };
  fuzz::call_one(size, {read, read, [&] { retrace::read_settings_file(config.string()); }});
  return 0;
}
