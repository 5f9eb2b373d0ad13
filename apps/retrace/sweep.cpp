#include "build.hpp"
#include "command.hpp"
#include "progress_bar.hpp"
#include "report/heat_picture.hpp"
#include "report/sweep_report.hpp"
#include "route_settings.hpp"
#include "run_directory.hpp"
#include "settings.hpp"
#include "sweep_grid.hpp"
#include "truth_options.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <spdlog/spdlog.h>

#include <place/cost_matrix.hpp>
#include <vo/base/error.hpp>
#include <vo/base/parallel.hpp>
#include <vo/io/atomic_file.hpp>

namespace retrace {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;
using vo::MotionSource;

constexpr const char* kReference = "reference";

struct SweepOptions {
  Settings settings;
  CommonOptions common;
  TruthOptions truth;
  std::string query;
  std::string reference;
  std::string output;
  std::vector<std::string> motions{"sad", "none"};
  std::vector<std::string> lengths{"5", "10", "20", "40"};
  std::vector<std::string> ranges{"0", "0.1", "0.2", "0.4", "0.6"};
  std::vector<std::string> vary;
};

struct Walks {
  vo::Walk query;
  vo::Walk reference;
};

/// Two walks cut down to keyframes, and how alike those are.
struct Sampled {
  std::vector<std::size_t> query_frames;
  std::vector<std::size_t> reference_frames;
  place::CostMatrix cost;
};

std::vector<Axis> axes_of(const SweepOptions& options) {
  std::vector<Axis> axes{{"motion", options.motions},
                         {"sequence-length", options.lengths},
                         {"search-range-rad", options.ranges}};
  for (const std::string& text : options.vary) {
    axes.push_back(parse_axis(text));
    const auto same = std::ranges::find(axes, axes.back().setting, &Axis::setting);
    if (same != axes.end() - 1)
      throw vo::Error("--vary " + text, "varies a setting twice",
                      fmt::format("one list of {}", same->setting));
  }
  return axes;
}

/// What `retrace build` and `retrace localise` make of the walks, up to the cost matrix.
Sampled sample(const Walks& walks, Settings settings) {
  place::Route route = new_route(settings);
  add_traverse(route, kReference, walks.reference, {}, settings);
  settings.sampling.sampling.unit = route.sampling.unit;
  const place::Traverse& reference = route.traverses.front();
  const place::SampledWalk query = place::sample_walk(walks.query, route, &reference, settings.sampling);
  Sampled sampled{.query_frames = query.frames, .reference_frames = {}, .cost = {}};
  for (const place::Keyframe& keyframe : reference.keyframes)
    sampled.reference_frames.push_back(static_cast<std::size_t>(keyframe.frame));
  sampled.cost =
      place::cost_matrix(vo::patch_normalise(query.thumbnails, route.patch),
                         vo::patch_normalise(reference.thumbnails, route.patch), settings.localiser.cost);
  return sampled;
}

/// Keeps every K-th frame, such that there are about as many keyframes as with the motion of `settings`.
int every_like(const Walks& walks, const Settings& settings) {
  const Sampled sampled = sample(walks, settings);
  const auto frames = static_cast<double>(walks.query.frames() + walks.reference.frames());
  const auto keyframes = static_cast<double>(sampled.query_frames.size() + sampled.reference_frames.size());
  return std::max(1, static_cast<int>(std::lround(frames / keyframes)));
}

std::optional<CellResult> run_cell(const Sampled& sampled, const place::CostMatrix& enhanced,
                                   const Settings& settings, RunTruth truth) {
  if (enhanced.references < static_cast<std::size_t>(settings.localiser.search.length)) return {};
  const auto matches = place::search_sequences(enhanced, settings.localiser.search);
  std::vector<place::ScoredQuery> queries;
  for (std::size_t q = 0; q < matches.size(); ++q) {
    std::optional<std::int64_t> reference;
    if (matches[q].reference)
      reference = static_cast<std::int64_t>(sampled.reference_frames[*matches[q].reference]);
    queries.push_back(
        judge(truth, static_cast<std::int64_t>(sampled.query_frames[q]), reference, matches[q].score));
  }
  const place::Evaluation e = place::evaluate(queries, truth.tolerance);
  return CellResult{.query_keyframes = enhanced.queries,
                    .reference_keyframes = enhanced.references,
                    .max_f1 = e.best.f1,
                    .max_f1_threshold = e.best.threshold,
                    .precision = e.best.precision,
                    .recall = e.best.recall,
                    .auc_pr = e.auc_pr,
                    .recall_at_100_precision = e.recall_at_100_precision,
                    .recall_at_1 = e.recall_at_1};
}

/// A sweep under way: what is to be done, what is done, and where it is kept.
class Sweep {
 public:
  Sweep(const SweepOptions& options, std::vector<Axis> axes, SweepResults done)
      : options_(options),
        axes_(std::move(axes)),
        results_(std::move(done)),
        truth_(read_truth(options.truth)) {
    for (const Cell& cell : all_cells(axes_)) {
      if (!results_.contains(cell)) missing_.push_back(cell);
    }
  }

  [[nodiscard]] const SweepResults& results() const { return results_; }
  [[nodiscard]] std::size_t missing() const { return missing_.size(); }

  /// Runs what is missing; false if the user stopped it.
  bool run(const CLI::App& app) {
    if (missing_.empty()) return true;
    read_walks();
    choose_every(app);
    ProgressBar bar;
    // Cells of one cost matrix stand together as the axes have them only by chance, so they are sorted.
    std::ranges::stable_sort(missing_, {}, [&](const Cell& cell) { return matrix_key(cell); });
    std::optional<Sampled> sampled;
    std::string sampled_for;
    for (std::size_t begin = 0; begin < missing_.size();) {
      std::size_t end = begin;
      while (end < missing_.size() && enhanced_key(missing_[end]) == enhanced_key(missing_[begin])) ++end;
      if (begin == 0 || sampled_for != matrix_key(missing_[begin])) {
        sampled_for = matrix_key(missing_[begin]);
        sampled = sample_or_warn(missing_[begin]);
      }
      if (!run_together(sampled, begin, end, bar.callback())) return false;
      begin = end;
    }
    return true;
  }

 private:
  [[nodiscard]] Settings settings(const Cell& cell) const {
    Settings settings = settings_at(options_.settings, axes_, cell);
    if (settings.sampling.sampling.motion == MotionSource::kNone && every_ > 0)
      settings.sampling.sampling.every = every_;
    return settings;
  }

  /// The values in a cell that its cost matrix depends on.
  [[nodiscard]] std::string matrix_key(const Cell& cell) const {
    std::string key;
    for (std::size_t i = 0; i < axes_.size(); ++i) {
      if (shapes_the_matrix(axes_[i].setting)) key += cell[i] + "\n";
    }
    return key;
  }

  /// The same for the enhanced one.
  [[nodiscard]] std::string enhanced_key(const Cell& cell) const {
    std::string key = matrix_key(cell);
    for (std::size_t i = 0; i < axes_.size(); ++i) {
      if (axes_[i].setting.starts_with("enhance")) key += cell[i] + "\n";
    }
    return key;
  }

  void read_walks() {
    vo::WalkOptions walk = options_.settings.walk;
    walk.preview_width_px = 0;
    for (const Cell& cell : missing_) {  // what any of them needs
      const vo::WalkOptions needed = settings(cell).walk;
      walk.track_features |= needed.track_features;
      walk.visual_odometry |= needed.visual_odometry;
    }
    ProgressBar bar;
    walks_.reference = vo::read_walk(options_.reference, walk, bar.callback());
    walks_.query = vo::read_walk(options_.query, walk, bar.callback());
  }

  /// Without motion, as many keyframes as the first motion gives, unless the user says how many.
  void choose_every(const CLI::App& app) {
    if (given(app, "--every")) return;
    for (const Cell& cell : all_cells(axes_)) {
      const Settings with_motion = settings(cell);
      if (with_motion.sampling.sampling.motion == MotionSource::kNone) continue;
      if (std::ranges::find(options_.motions, "none") != options_.motions.end() &&
          std::ranges::find(axes_, "every", &Axis::setting) == axes_.end())
        every_ = every_like(walks_, with_motion);
      return;
    }
  }

  std::optional<Sampled> sample_or_warn(const Cell& cell) const {
    try {
      return sample(walks_, settings(cell));
    } catch (const vo::Error& error) {
      spdlog::warn("motion {}: {}", cell.front(), error.what());
      return {};
    }
  }

  /// The missing cells from `begin` to `end`, which share one enhanced matrix. The file is renewed after
  /// every few, so that a sweep that is killed goes on from there.
  bool run_together(const std::optional<Sampled>& sampled, std::size_t begin, std::size_t end,
                    const vo::ProgressCallback& progress) {
    place::CostMatrix enhanced;
    if (sampled) {
      enhanced = sampled->cost;
      place::enhance_contrast(enhanced, settings(missing_[begin]).localiser.enhancement);
    }
    const std::size_t together = 4 * static_cast<std::size_t>(vo::thread_count());
    for (; begin < end; begin += together) {
      const std::size_t count = std::min(together, end - begin);
      std::vector<std::optional<CellResult>> found(count);
      if (sampled) {
        vo::parallel_for(count, [&](std::size_t i) {
          found[i] = run_cell(*sampled, enhanced, settings(missing_[begin + i]), truth_);
        });
      }
      for (std::size_t i = 0; i < count; ++i) results_[missing_[begin + i]] = found[i];
      vo::write_file(fs::path(options_.output) / "sweep.csv", sweep_csv(axes_, results_));
      if (!progress({.stage = "sweeping",
                     .done = static_cast<std::int64_t>(begin + count),
                     .total = static_cast<std::int64_t>(missing_.size())}))
        return false;
    }
    return true;
  }

  const SweepOptions& options_;
  std::vector<Axis> axes_;
  SweepResults results_;
  RunTruth truth_;
  std::vector<Cell> missing_;
  Walks walks_;
  int every_ = 0;  ///< frames between keyframes without motion; 0: as the settings say
};

/// What a sweep is of; another one does not go into the same folder.
std::string description(const SweepOptions& options, const std::vector<Axis>& axes) {
  std::string text = fmt::format(
      "# Sweep of {} on {}\n# truth: {} {} {}, tolerance {} {}\n# varied:", options.query, options.reference,
      options.truth.pairs, options.truth.query_truth, options.truth.reference_truth,
      options.truth.tolerance_m.value_or(options.truth.tolerance_frames.value_or(0)),
      options.truth.tolerance_m ? "m" : "reference frames");
  for (const Axis& axis : axes) text += " " + axis.setting;
  Settings settings = options.settings;
  settings.threads = 0;  // makes no difference
  return text + "\n" + to_toml(settings);
}

/// What was done before, if the folder holds the same sweep. Throws if it holds another.
SweepResults resume(const fs::path& folder, const std::vector<Axis>& axes, const std::string& description,
                    bool force) {
  prepare_run_directory(folder, {}, true);
  const fs::path mark = folder / "sweep.toml";
  SweepResults done;
  if (!force) {
    std::ifstream file(mark);
    const std::string before{std::istreambuf_iterator<char>(file), {}};
    if (fs::exists(mark) ? before != description : fs::exists(folder / "sweep.csv")) {
      throw vo::Error(folder.string(), "holds another sweep", "another folder, or --force to begin anew");
    }
    done = read_sweep(folder / "sweep.csv", axes);
  }
  vo::write_file(folder / "sweep.csv", sweep_csv(axes, done));
  vo::write_file(mark, description);
  return done;
}

std::string flags_of(const std::vector<Axis>& axes, const Cell& cell) {
  std::string flags;
  for (std::size_t i = 0; i < axes.size(); ++i) flags += fmt::format(" --{} {}", axes[i].setting, cell[i]);
  return flags;
}

ordered_json cell_json(const std::vector<Axis>& axes, const Cell& cell,
                       const std::optional<CellResult>& result) {
  ordered_json json;
  for (std::size_t i = 0; i < axes.size(); ++i) json[axes[i].setting] = cell[i];
  if (!result) return json;
  json.update({{"query_keyframes", result->query_keyframes},
               {"reference_keyframes", result->reference_keyframes},
               {"max_f1", result->max_f1},
               {"precision", result->precision},
               {"recall", result->recall},
               {"auc_pr", result->auc_pr}});
  return json;
}

void print(const SweepOptions& options, const std::vector<Axis>& axes, const SweepResults& results) {
  const std::optional<Cell> best = best_cell(axes, results);
  if (options.common.json) {
    ordered_json json{{"best", nullptr}, {"cells", ordered_json::array()}};
    if (best) json["best"] = cell_json(axes, *best, results.at(*best));
    for (const Cell& cell : all_cells(axes)) json["cells"].push_back(cell_json(axes, cell, results.at(cell)));
    fmt::print("{}\n", json.dump(2));
    return;
  }
  fmt::print("  {:<8}{:>14}{:>8}{:>11}{:>9}   {}\n", "motion", "keyframes", "max-F1", "precision", "recall",
             "at");
  for (const std::string& motion : options.motions) {
    const std::optional<Cell> cell = best_cell(axes, results, motion);
    if (!cell) continue;
    const CellResult& r = *results.at(*cell);
    fmt::print("  {:<8}{:>14}{:>8.3f}{:>11.3f}{:>9.3f}  {}\n", motion,
               fmt::format("{} x {}", r.query_keyframes, r.reference_keyframes), r.max_f1, r.precision,
               r.recall, flags_of(axes, *cell));
  }
  if (best) fmt::print("best:{}\n", flags_of(axes, *best));
  fmt::print("{} cells; see {}\n", results.size(), (fs::path(options.output) / "report.html").string());
}

void sweep(const CLI::App& app, const SweepOptions& options) {
  vo::set_thread_count(options.settings.threads);
  const std::vector<Axis> axes = axes_of(options);
  for (const Cell& cell : all_cells(axes))
    settings_at(options.settings, axes, cell);  // are they all in range?
  const fs::path folder = options.output;
  const std::string what = description(options, axes);
  Sweep sweep(options, axes, resume(folder, axes, what, options.common.force));
  if (!sweep.run(app)) {
    throw vo::Error(options.output, "the sweep was stopped",
                    "the same command again, which goes on from here");
  }
  const std::string tolerance = options.truth.tolerance_m
                                    ? fmt::format("{:g} metres", *options.truth.tolerance_m)
                                    : fmt::format("{:g} reference frames", *options.truth.tolerance_frames);
  vo::write_file(
      folder / "report.html",
      sweep_report(axes, sweep.results(), fmt::format("{} on {}", options.query, options.reference),
                   {{"Cells", std::to_string(sweep.results().size())}, {"Right is within", tolerance}}));
  const std::vector<std::uint8_t> png = heat_picture(heat_tables(axes, sweep.results()));
  vo::write_file(folder / "heat_map.png", {reinterpret_cast<const char*>(png.data()), png.size()});
  print(options, axes, sweep.results());
}

/// Replaces a setting of one value by a list of them.
void add_list(CLI::App& app, const std::string& name, std::vector<std::string>& values,
              const std::string& description) {
  if (CLI::Option* single = app.get_option_no_throw(name)) app.remove_option(single);
  app.add_option(name, values, description)->delimiter(',')->capture_default_str()->group("Swept");
}

}  // namespace

Command add_sweep(CLI::App& root) {
  auto options = std::make_shared<SweepOptions>();
  CLI::App* app =
      root.add_subcommand("sweep", "which settings find a walk on another best, by precision and recall");
  app->add_option("query", options->query, "walk to be found: video file or folder of images")->required();
  app->add_option("--reference", options->reference, "walk to be found on")->required();
  app->add_option("-o,--output", options->output, "folder for the results; a sweep that was stopped goes on")
      ->required();
  add_truth_options(*app, options->truth);
  add_all_options(*app, options->settings);
  add_list(*app, "--motion", options->motions, "sad, steps, hybrid, vo, none: what walks are resampled by");
  add_list(*app, "--sequence-length", options->lengths, "keyframes on a line [SSS 4.2]");
  add_list(*app, "--search-range-rad", options->ranges, "radians either side of pi/4 [SSS Fig. 8]");
  app->add_option("--vary", options->vary,
                  "NAME=a,b,c: any further setting of sampling or search; may be repeated")
      ->group("Swept")
      ->take_all();
  for (const char* name : {"--compat", "--sequence-length-m"}) app->remove_option(app->get_option(name));
  add_config_option(*app, options->common);
  add_force_option(*app, options->common);
  add_json_option(*app, options->common);
  app->footer(
      "Both walks are read once; a cost matrix is computed once for all cells that share it. With --motion "
      "none and no\n"
      "--every, every so many frames are kept that there are as many keyframes as with the first other "
      "motion.\n"
      "Examples:\n"
      "  retrace sweep night.mp4 --reference day.mp4 --query-truth night.csv --reference-truth day.csv \\\n"
      "    --tolerance-m 4 -o sweep\n"
      "  retrace sweep night.mp4 --reference day.mp4 --pairs pairs.csv --tolerance-frames 17 -o sweep \\\n"
      "    --motion sad,steps,none --sequence-length 5,10,20,40,80 --vary enhance=local,standardise");
  return {app, [app, options] { sweep(*app, *options); }};
}

}  // namespace retrace
