#include "follow_files.hpp"

#include "settings_file.hpp"
#include "trajectory_files.hpp"

#include <algorithm>

#include <nlohmann/json.hpp>

#include <place/match/match_io.hpp>
#include <place/match/nearest_place.hpp>
#include <place/version.hpp>
#include <vo/io/atomic_file.hpp>

namespace retrace {

const std::vector<std::string> kFollowFiles{"follow.jsonl",   "report.html",  "matches.csv",
                                            "trajectory.tum", "summary.json", "config.toml"};

void write_follow_files(const std::filesystem::path& folder, const FollowRun& run, const place::Route& route,
                        const place::Settings& settings, std::vector<place::Match> matches) {
  place::name_places(matches, route);
  using nlohmann::ordered_json;
  const auto accepted = std::ranges::count_if(matches, &place::Match::accepted);
  ordered_json summary{{"query", run.walk},
                       {"query_frames", run.frames},
                       {"query_start_utc_s", run.start_utc_s ? ordered_json(*run.start_utc_s) : nullptr},
                       {"query_duration_s", run.duration_s},
                       {"query_frames_after_gaps", ordered_json::array()},
                       {"route", run.route},
                       {"traverses", ordered_json::array()},
                       {"queries", matches.size()},
                       {"matched", accepted},
                       {"accepted", accepted},
                       {"frames_on_route", run.on_route},
                       {"frames_skipped", run.skipped},
                       {"lag_s", run.lag_s},
                       {"warnings", run.warnings},
                       {"version", place::kVersion}};
  for (const place::Traverse& traverse : route.traverses)
    summary["traverses"].push_back({{"name", traverse.name}, {"keyframes", traverse.keyframes.size()}});
  vo::write_file(folder / "matches.csv", place::to_csv(matches));
  place::QueryTrajectory places;
  places.why_not = "as it was followed";
  write_trajectory(places, route, matches, folder, run.start_utc_s);
  vo::write_file(folder / "summary.json",
                 summary.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n");
  vo::write_file(folder / "config.toml", to_toml(settings));
}

}  // namespace retrace
