#include "sweep_run.hpp"

#include "progress_bar.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>

#include <spdlog/spdlog.h>

#include <place/place.hpp>
#include <place/stage_options.hpp>
#include <vo/base/error.hpp>
#include <vo/base/parallel.hpp>
#include <vo/io/atomic_file.hpp>

namespace retrace {
namespace {

namespace fs = std::filesystem;

constexpr const char* kReference = "reference";

struct Walks {
  vo::Walk query;
  vo::Walk reference;
};

/// Two walks cut down to keyframes, and how alike those are.
struct Sampled {
  std::vector<std::size_t> query_frames;
  std::vector<std::int64_t> reference_frames;
  place::CostMatrix cost;
  place::SearchOptions search;  ///< the gaps and steps of the query
};

/// Both walks on one route, up to the cost matrix.
Sampled sample(const Walks& walks, const place::Settings& given) {
  place::Route route = place::new_route(given);
  place::add(route, kReference, walks.reference, {}, given);
  const place::Settings settings = place::resolve(given, {.route = &route.settings, .pass_over = true});
  const place::StageOptions options = place::stage_options(settings);
  const place::SampledWalk query = place::sample_walk(walks.query, options.sampling, &route);
  const place::Traverse& reference = route.traverses.front();
  Sampled sampled{.query_frames = query.frames, .reference_frames = {}, .cost = {}, .search = {}};
  for (const place::Keyframe& keyframe : reference.keyframes)
    sampled.reference_frames.push_back(keyframe.frame);
  const place::RouteMatchingOptions& matching = options.matching;
  sampled.cost = place::cost_matrix_on_route(query, reference, matching);
  sampled.search = place::search_on_route(reference, walks.query.time_s, query, matching);
  return sampled;
}

/// Keeps every K-th frame, such that there are about as many keyframes as with the motion of `settings`.
int every_like(const Walks& walks, const place::Settings& settings) {
  const Sampled sampled = sample(walks, settings);
  const auto frames = static_cast<double>(walks.query.frames() + walks.reference.frames());
  const auto keyframes = static_cast<double>(sampled.query_frames.size() + sampled.reference_frames.size());
  return std::max(1, static_cast<int>(std::lround(frames / keyframes)));
}

std::optional<CellResult> run_cell(const Sampled& sampled, const place::CostMatrix& enhanced,
                                   const place::RouteMatchingOptions& matching,
                                   const place::GroundTruth& truth, const place::Tolerance& tolerance) {
  place::SearchOptions search = sampled.search;
  search.sequence = matching.search;
  if (enhanced.references < static_cast<std::size_t>(search.sequence.length)) return {};
  std::vector<place::Match> matches;
  for (const place::SequenceMatch& found :
       place::search_method(matching.method).search(enhanced, search).matches) {
    place::Match& match = matches.emplace_back();
    match.query_frame = static_cast<std::int64_t>(sampled.query_frames[matches.size() - 1]);
    match.score = found.score;
    if (found.reference) match.place.emplace().frame = sampled.reference_frames[*found.reference];
  }
  const place::Evaluation e = place::evaluate(matches, truth, tolerance).evaluation;
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
  Sweep(const SweepOptions& options, const std::vector<Axis>& axes, SweepResults& results)
      : options_(options), axes_(axes), results_(results), truth_(read_truth(options.truth).places) {
    for (const Cell& cell : all_cells(axes_)) {
      if (!results_.contains(cell)) missing_.push_back(cell);
    }
  }

  /// Runs what is missing; false if the user stopped it.
  bool run() {
    if (missing_.empty()) return true;
    if (!options_.settings.every) choose_every();
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
  /// What is given in a cell and has an effect there.
  [[nodiscard]] place::Settings settings(const Cell& cell) const {
    place::Settings given = settings_at(options_.settings, axes_, cell);
    if (given.motion == "none" && every_ > 0) given.every = every_;
    const place::Settings resolved = place::resolve(given, {.pass_over = true});
    for (const place::Setting& setting : place::settings_table())
      if (!place::text_of(resolved, setting)) place::reset(given, setting);
    return given;
  }

  /// The options of a cell's stages.
  [[nodiscard]] place::StageOptions stages(const Cell& cell) const {
    return place::stage_options(place::resolve(settings(cell), {}));
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

  /// Both walks, with what a cell's descriptor keeps of them; read once for each descriptor.
  const Walks& walks(const Cell& cell) {
    const std::string descriptor = settings(cell).descriptor.value_or("");
    const auto known = walks_.find(descriptor);
    if (known != walks_.end()) return known->second;
    vo::WalkOptions walk = stages(cell).walk;
    walk.preview_width_px = 0;
    for (const Cell& other : missing_) {  // what any of them needs
      const vo::WalkOptions needed = stages(other).walk;
      walk.track_features |= needed.track_features;
      walk.visual_odometry |= needed.visual_odometry;
    }
    ProgressBar bar;
    Walks& both = walks_[descriptor];
    both.reference = vo::read_walk(options_.reference, walk, bar.callback());
    both.query = vo::read_walk(options_.query, walk, bar.callback());
    return both;
  }

  /// Without motion, as many keyframes as the first motion gives.
  void choose_every() {
    for (const Cell& cell : all_cells(axes_)) {
      const place::Settings with_motion = settings(cell);
      if (with_motion.motion == "none") continue;
      if (std::ranges::find(options_.motions, "none") != options_.motions.end() &&
          std::ranges::find(axes_, "every", &Axis::setting) == axes_.end())
        every_ = every_like(walks(cell), with_motion);
      return;
    }
  }

  std::optional<Sampled> sample_or_warn(const Cell& cell) {
    try {
      return sample(walks(cell), settings(cell));
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
      const place::RouteMatchingOptions matching = stages(missing_[begin]).matching;
      place::ContrastEnhancementOptions enhancement = matching.enhancement;
      enhancement.prior_queries = place::prior_queries_of(matching);
      place::enhance_contrast(enhanced, enhancement);
    }
    const std::size_t together = 4 * static_cast<std::size_t>(vo::thread_count());
    for (; begin < end; begin += together) {
      const std::size_t count = std::min(together, end - begin);
      std::vector<std::optional<CellResult>> found(count);
      if (sampled) {
        vo::parallel_for(count, [&](std::size_t i) {
          found[i] = run_cell(*sampled, enhanced, stages(missing_[begin + i]).matching, truth_,
                              options_.truth.tolerance);
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
  const std::vector<Axis>& axes_;
  SweepResults& results_;
  place::GroundTruth truth_;
  std::vector<Cell> missing_;
  std::map<std::string, Walks> walks_;  ///< by descriptor
  int every_ = 0;                       ///< frames between keyframes without motion; 0: as the settings say
};

}  // namespace

bool run_sweep(const SweepOptions& options, const std::vector<Axis>& axes, SweepResults& results) {
  return Sweep(options, axes, results).run();
}

}  // namespace retrace
