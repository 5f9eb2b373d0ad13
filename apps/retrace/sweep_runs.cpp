#include "sweep_runs.hpp"

#include "arguments.hpp"
#include "progress_bar.hpp"
#include "sweep_pairs.hpp"

#include <algorithm>
#include <filesystem>
#include <set>
#include <utility>

#include <spdlog/spdlog.h>

#include <vo/base/error.hpp>
#include <vo/io/frame_source.hpp>

namespace retrace {
namespace {

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

}  // namespace

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
  for (PairSweep& sweep : sweeps) {
    sweep.truth = read_truth(sweep.options.truth).places;
    if (options.merge) continue;  // walks are read only for what is compared
    for (const auto* walk : {&sweep.options.query, &sweep.options.reference})
      vo::open_frame_source(*walk);  // refused before anything is begun anew
  }
  return sweeps;
}

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

}  // namespace retrace
