#include "benchmark_files.hpp"
#include "command.hpp"
#include "progress_bar.hpp"
#include "sweep_files.hpp"
#include "sweep_pairs.hpp"

#include <algorithm>
#include <filesystem>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <vo/base/error.hpp>
#include <vo/base/parallel.hpp>

namespace retrace {
namespace {

std::vector<place::SweepAxis> axes_of(const SweepOptions& options) {
  const bool metres = !options.lengths_m.empty();
  if (metres && !options.lengths.empty())
    throw vo::Error("--sequence-length-m", "is given beside --sequence-length", "one of both");
  std::vector<std::string> lengths = metres ? options.lengths_m : options.lengths;
  if (lengths.empty()) lengths = {"5", "10", "20", "40"};
  std::vector<place::SweepAxis> axes{{"motion", options.motions},
                                     {metres ? "sequence-length-m" : "sequence-length", lengths},
                                     {"search-range-rad", options.ranges}};
  for (const std::string& text : options.vary) {
    axes.push_back(place::parse_axis(text));
    const auto same = std::ranges::find(axes, axes.back().setting, &place::SweepAxis::setting);
    if (same != axes.end() - 1)
      throw vo::Error("--vary " + text, "varies a setting twice",
                      fmt::format("one list of {}", same->setting));
  }
  return axes;
}

/// One pair's sweep, with its own folder; all that is there, without a list.
struct PairSweep {
  std::string name;
  SweepOptions options;
  place::GroundTruth truth;
};

std::vector<PairSweep> pair_sweeps(const SweepOptions& options) {
  const bool given = !options.query.empty() || !options.reference.empty() || !options.truth.pairs.empty() ||
                     !options.truth.query_truth.empty() || !options.truth.reference_truth.empty() ||
                     options.truth.tolerance.tolerance_m || options.truth.tolerance.tolerance_frames;
  std::vector<PairSweep> sweeps;
  if (options.list.empty()) {
    if (options.query.empty()) throw UsageError("query is required, or --list with pairs of walks");
    if (options.reference.empty()) throw UsageError("--reference is required");
    if (const std::string lack = what_truth_lacks(options.truth); !lack.empty())
      throw UsageError("the truth is incomplete, or given twice: expected " + lack);
    sweeps.push_back({"", options, {}});
  } else {
    if (given) throw UsageError("--list holds walks, truth and tolerance; expected none of them beside it");
    for (WalkPairEntry& pair : read_walk_pairs(options.list)) {
      SweepOptions of_pair = options;
      of_pair.query = std::move(pair.query);
      of_pair.reference = std::move(pair.reference);
      of_pair.truth = std::move(pair.truth);
      of_pair.output = (std::filesystem::path(options.output) / pair.name).string();
      sweeps.push_back({pair.name, std::move(of_pair), {}});
    }
  }
  for (PairSweep& sweep : sweeps) sweep.truth = read_truth(sweep.options.truth).places;
  return sweeps;
}

/// Calls `body` with the inputs of a pair's sweep; false if it was stopped.
template <typename Body>
bool with_walks(const PairSweep& pair, ProgressBar& bar, const Body& body) {
  std::set<std::string> said;  // a walk may be read several times
  const auto reader = [&](const std::vector<std::string>& sources) {
    return [&](const vo::WalkOptions& walk) {
      vo::Walk read = vo::read_walk(sources, walk, bar.callback());
      for (const std::string& warning : read.warnings)
        if (said.insert(warning).second) spdlog::warn("{}", warning);
      return read;
    };
  };
  const place::SweepInput input{.query = reader(pair.options.query),
                                .reference = reader(pair.options.reference),
                                .truth = pair.truth,
                                .tolerance = pair.options.truth.tolerance,
                                .settings = pair.options.settings,
                                .equal_keyframes = pair.options.equal_keyframes};
  return body(input);
}

[[noreturn]] void stopped(const std::string& folder) {
  throw vo::Error(folder, "the sweep was stopped", "the same command again, which goes on from here");
}

/// Runs the cells of all pairs that one process of several has, and keeps them in files of its own.
void sweep_part(const std::vector<PairSweep>& pairs, const SweepOptions& options,
                const std::vector<place::SweepAxis>& axes) {
  const place::SweepPart part = place::parse_part(options.cell);
  const std::vector<place::SweepCell> cells = place::cells_by_work(axes);
  const place::PartRange mine = place::range_of_part(part, cells.size() * pairs.size());
  std::size_t found = 0;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const std::size_t begin = std::clamp(mine.begin, i * cells.size(), (i + 1) * cells.size());
    const std::size_t end = std::clamp(mine.end, i * cells.size(), (i + 1) * cells.size());
    if (begin == end) continue;
    const SweepOptions& of_pair = pairs[i].options;
    place::SweepResults results = resume_sweep(of_pair, axes);
    const std::vector<place::SweepCell> wanted(
        cells.begin() + static_cast<std::ptrdiff_t>(begin - i * cells.size()),
        cells.begin() + static_cast<std::ptrdiff_t>(end - i * cells.size()));
    const auto keep = [&](const place::SweepResults& all) {
      place::SweepResults of_part;
      for (const place::SweepCell& cell : wanted)
        if (const auto done = all.find(cell); done != all.end()) of_part.insert(*done);
      write_part(of_pair, axes, part, of_part);
    };
    ProgressBar bar;
    const place::SweepCallbacks callbacks{.keep = keep,
                                          .warn = [](const std::string& text) { spdlog::warn("{}", text); },
                                          .progress = bar.callback()};
    const bool finished = with_walks(pairs[i], bar, [&](const place::SweepInput& input) {
      return place::run_cells(input, axes, wanted, results, callbacks);
    });
    if (!finished) stopped(of_pair.output);
    keep(results);
    found += wanted.size();
  }
  print_part(options, part, found, cells.size() * pairs.size());
}

/// A pair's sweep as a whole: runs what is missing, or with `merge` refuses if anything is; then the report.
SweptPair sweep_pair(const PairSweep& pair, const std::vector<place::SweepAxis>& axes) {
  const SweepOptions& options = pair.options;
  SweptPair swept{.name = pair.name, .results = resume_sweep(options, axes), .methods = {}};
  if (options.merge) {
    check_all_there(options, axes, swept.results);
    write_sweep_csv(options, axes, swept.results);
  }
  bool finished = false;
  {
    ProgressBar bar;
    const place::SweepCallbacks callbacks{
        .keep = [&](const place::SweepResults& all) { write_sweep_csv(options, axes, all); },
        .warn = [](const std::string& warning) { spdlog::warn("{}", warning); },
        .progress = bar.callback()};
    finished = with_walks(pair, bar, [&](const place::SweepInput& input) {
      if (!place::sweep(input, axes, swept.results, callbacks)) return false;
      swept.methods = place::compare_methods(input, axes, options.compare, swept.results, callbacks);
      return true;
    });
  }
  if (!finished) stopped(options.output);
  write_sweep_report(options, axes, swept.results, swept.methods);
  remove_parts(options);
  return swept;
}

void sweep(const SweepOptions& options) {
  vo::set_thread_count(options.settings.threads.value_or(0));
  const std::vector<place::SweepAxis> axes = axes_of(options);
  place::check_sweep(options.settings, axes, options.equal_keyframes);
  place::check_compared(axes, options.compare);
  const std::vector<PairSweep> pairs = pair_sweeps(options);
  if (!options.cell.empty()) {
    sweep_part(pairs, options, axes);
    return;
  }
  if (options.merge) {  // all of them, before the work on any
    for (const PairSweep& pair : pairs) check_all_there(pair.options, axes, resume_sweep(pair.options, axes));
  }
  std::vector<SweptPair> swept;
  for (const PairSweep& pair : pairs) swept.push_back(sweep_pair(pair, axes));
  if (options.list.empty()) {
    print_sweep(options, axes, swept.front().results, swept.front().methods);
  } else {
    write_benchmark(options, axes, swept);
    print_benchmark(options, axes, swept);
  }
}

}  // namespace

std::function<void()> declare_sweep(Arguments& arguments) {
  auto options = std::make_shared<SweepOptions>();
  arguments
      .positional(
          "query", options->query,
          "walk to be found: a video file or a folder of images; several files, in order, are one walk")
      .optional();
  arguments.option("--reference", options->reference,
                   "walk to be found on; several files, in order, are one walk");
  arguments.option("--list", options->list,
                   "TOML file of pairs of walks instead: a benchmark of all, with one table and one page");
  arguments.option("-o,--output", options->output, "folder for the results; a sweep that was stopped goes on")
      .required();
  declare_optional_truth(arguments, options->truth);
  const Argument cell =
      arguments.option("--cell", options->cell, "I/N: only the I-th of N parts of the cells, each a process");
  arguments.flag("--merge", options->merge, "put the parts together, when all of them are done")
      .excludes(cell);
  const auto list = [&](const char* flag, std::vector<std::string>& values, const char* description) {
    arguments.option(flag, values, description).comma_separated().group("Swept");
  };
  list("--motion", options->motions, "sad, steps, hybrid, vo, none: what walks are resampled by");
  list("--sequence-length", options->lengths, "keyframes on a line [5,10,20,40; SSS 4.2]");
  list("--sequence-length-m", options->lengths_m, "metres on a line, instead; needs --reference-truth");
  list("--search-range-rad", options->ranges, "radians either side of pi/4 [SSS Fig. 8]");
  arguments.option("--vary", options->vary, "NAME=a,b,c: any further setting; may be repeated")
      .group("Swept");
  list("--compare", options->compare, "swept settings whose values make the methods that are compared");
  arguments
      .flag("--equal-keyframes", options->equal_keyframes,
            "as many keyframes, within 5 %, in every cell as with none, or else as in the first cell")
      .group("Swept");
  using enum place::SettingGroup;
  arguments.settings(options->settings, {kReading, kDescribing, kMotion, kOdometry, kSearch, kGeneral},
                     {"motion", "sequence-length", "search-range-rad", "compat", "sequence-length-m",
                      "motion-file", "motion-file-start-s", "motion-file-gap-s", "view-points", "verify"});
  arguments.common(options->common);
  arguments.footer(
      "Walks are read once for all cells that keep the same of them; a cost matrix is computed once for all "
      "cells that share\n"
      "it. With --motion none and no --every, every so many frames are kept that there are about as many "
      "keyframes as with the\n"
      "first other motion. Each method is compared at its best and at the defaults, by a paired bootstrap.\n"
      "Examples:\n"
      "  retrace sweep night.mp4 --reference day.mp4 --query-truth night.csv --reference-truth day.csv \\\n"
      "    --tolerance-m 4 -o sweep\n"
      "  retrace sweep night.mp4 --reference day.mp4 --pairs pairs.csv --tolerance-frames 17 -o sweep \\\n"
      "    --motion none,sad,steps --equal-keyframes --vary enhance=local,standardise --compare "
      "motion,enhance\n"
      "  retrace sweep --list pairs.toml -o benchmark    with pairs.toml, a section for each pair:\n"
      "    [park]\n"
      "    query = \"winter.mp4\"\n"
      "    reference = \"summer.mp4\"\n"
      "    pairs = \"landmarks.csv\"    or query-truth and reference-truth\n"
      "    tolerance-frames = 17      or tolerance-m\n"
      "  Four processes share a sweep; Slurm's job arrays do it with apps/slurm/sweep.sbatch:\n"
      "    parallel retrace sweep --list pairs.toml -o benchmark --threads 1 --cell {}/4 ::: 1 2 3 4\n"
      "    retrace sweep --list pairs.toml -o benchmark --merge");
  return [options] { sweep(*options); };
}

}  // namespace retrace
