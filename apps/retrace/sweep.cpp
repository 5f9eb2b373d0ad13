#include "benchmark_files.hpp"
#include "command.hpp"
#include "sweep_axes.hpp"
#include "sweep_files.hpp"
#include "sweep_runs.hpp"

#include <memory>
#include <vector>

#include <vo/base/parallel.hpp>

namespace retrace {
namespace {

void sweep(const SweepOptions& options) {
  vo::set_thread_count(options.settings.threads.value_or(0));
  const std::vector<place::SweepAxis> axes = swept_axes(options);
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
  declare_swept(arguments, *options);
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
