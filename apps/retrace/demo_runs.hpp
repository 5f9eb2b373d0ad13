#pragma once

#include "run_files.hpp"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <place/place.hpp>
#include <simulate/recorder.hpp>

/// What `retrace demo` does with its two walks: the same as `build`, `localise` and `evaluate`.
namespace retrace {

constexpr double kDemoTolerance_m = 4;  // SSS 4.2
/// The papers' descriptor, which shows the effect of sampling: blocks find this walk either way.
constexpr const char* kDemoDescriptor = "thumbnail";

/// A walk drawn into a folder and read back from its video.
struct DrawnWalk {
  std::filesystem::path folder;
  vo::Walk walk;

  [[nodiscard]] std::string video() const { return (folder / "walk.mp4").string(); }
  [[nodiscard]] std::string truth() const { return (folder / "truth.csv").string(); }
};

/// The night walk found on the day walk, with one kind of sampling.
struct DemoRun {
  std::filesystem::path folder;
  int every = 0;  ///< frames between keyframes, without motion
  std::size_t references = 0;
  WrittenRun written;
  place::RunEvaluation evaluated;
};

/// The two walks: by day slow, then fast; by night another walker, a little to the side, fast, then slow.
simulate::Options demo_day(std::uint64_t seed, double length_m);
simulate::Options demo_night(const simulate::Options& by_day);

/// Draws a walk into a folder and reads it. Throws `vo::Error` if the user stopped it: half a demo is
/// useless.
DrawnWalk draw_and_read(const simulate::Options& options, const std::filesystem::path& folder,
                        const place::Settings& settings);

/// What `retrace build`, `localise` and `evaluate` do, one after the other.
DemoRun find_night_on_day(const DrawnWalk& day, const DrawnWalk& night, const place::Settings& settings,
                          const std::filesystem::path& route_file, const std::filesystem::path& folder);

/// Settings that keep every K-th frame, so that there are about as many keyframes as in `run`.
place::Settings vanilla_like(const DemoRun& run, const DrawnWalk& day, const DrawnWalk& night);

/// A PNG: the same place by day and by night, and the cost matrices of both runs with their matches.
std::vector<std::uint8_t> demo_overview(const DrawnWalk& day, const DrawnWalk& night, const DemoRun& vanilla,
                                        const DemoRun& normalised, double length_m);

}  // namespace retrace
