// What a report is drawn from: matches.csv, report_data.json, summary.json, config.toml and trajectory.tum of
// a run, between lines of %%.
#include "fuzz.hpp"
#include "report/run_data.hpp"
#include "report/run_report.hpp"

#include <nlohmann/json.hpp>

#include <place/match/match_io.hpp>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto parts = fuzz::parts({data, size}, 5);
  std::size_t i = 0;
  for (const char* name :
       {"matches.csv", retrace::kRunDataFile, "summary.json", "config.toml", "trajectory.tum"})
    fuzz::write(name, parts[i++]);
  const std::filesystem::path& folder = fuzz::folder();
  constexpr std::size_t kPage = 1U << 20U;  // the page, its texts and axes
  const auto evaluated = [&](const place::GroundTruth& known, const place::Tolerance& tolerance) {
    return [&folder, known, tolerance] {
      const std::vector<place::Match> matches = place::read_matches(folder / "matches.csv");
      retrace::RunTruth truth;
      static_cast<place::RunEvaluation&>(truth) = place::evaluate(matches, known, tolerance);
      truth.truth = known;
      retrace::run_report(folder, retrace::read_run_data(folder), &truth);
    };
  };
  fuzz::call_one(
      size,
      {[&] { retrace::run_report(folder, retrace::read_run_data(folder)); },
       evaluated({.pairs = place::LandmarkPairs{{0, 100}, {0, 100}}}, {.tolerance_frames = 2}),
       evaluated({.pairs = {}, .query_distance_m = {0, 1, {}, 2}, .reference_distance_m = {0, 1, 2, 3}},
                 {.tolerance_m = 2})},
      kPage);
  return 0;
}
