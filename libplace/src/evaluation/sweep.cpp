#include "place/evaluation/sweep.hpp"

#include "place/place.hpp"
#include "place/stage_options.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include <vo/base/error.hpp>
#include <vo/base/parallel.hpp>

namespace place {
namespace {

constexpr const char* kReference = "reference";

struct Walks {
  vo::Walk query;
  vo::Walk reference;
};

/// Two walks reduced to keyframes, and their costs.
struct Sampled {
  std::vector<std::size_t> query_frames;
  std::vector<std::int64_t> reference_frames;
  CostMatrix cost;
  SearchOptions search;  ///< the gaps and steps of the query
};

/// Both walks on one route, up to the cost matrix.
Sampled sample(const Walks& walks, const Settings& given) {
  Route route = new_route(given);
  add(route, kReference, walks.reference, {}, given);
  const Settings settings = resolve(given, {.route = &route.settings, .pass_over = true});
  const StageOptions options = stage_options(settings);
  const SampledWalk query = sample_walk(walks.query, options.sampling, &route);
  const Traverse& reference = route.traverses.front();
  Sampled sampled{.query_frames = query.frames, .reference_frames = {}, .cost = {}, .search = {}};
  for (const Keyframe& keyframe : reference.keyframes) sampled.reference_frames.push_back(keyframe.frame);
  const RouteMatchingOptions& matching = options.matching;
  sampled.cost = cost_matrix_on_route(query, reference, matching);
  sampled.search = search_on_route(reference, walks.query.time_s, query, matching);
  return sampled;
}

/// Keeps every K-th frame, so that there are about as many keyframes as with the motion of `settings`.
int every_like(const Walks& walks, const Settings& settings) {
  const Sampled sampled = sample(walks, settings);
  const auto frames = static_cast<double>(walks.query.frames() + walks.reference.frames());
  const auto keyframes = static_cast<double>(sampled.query_frames.size() + sampled.reference_frames.size());
  return std::max(1, static_cast<int>(std::lround(frames / keyframes)));
}

std::optional<CellResult> run_cell(const Sampled& sampled, const CostMatrix& enhanced,
                                   const RouteMatchingOptions& matching, const GroundTruth& truth,
                                   const Tolerance& tolerance) {
  SearchOptions search = sampled.search;
  search.sequence = matching.search;
  if (enhanced.references < static_cast<std::size_t>(search.sequence.length)) return {};
  std::vector<Match> matches;
  for (const SequenceMatch& found : search_method(matching.method).search(enhanced, search).matches) {
    Match& match = matches.emplace_back();
    match.query_frame = static_cast<std::int64_t>(sampled.query_frames[matches.size() - 1]);
    match.score = found.score;
    if (found.reference) match.place.emplace().frame = sampled.reference_frames[*found.reference];
  }
  const Evaluation e = evaluate(matches, truth, tolerance).evaluation;
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

/// A sweep in progress: what remains, what is done, and where it is kept.
class Sweep {
 public:
  Sweep(const SweepInput& input, const std::vector<SweepAxis>& axes, SweepResults& results,
        const SweepCallbacks& callbacks)
      : input_(input), axes_(axes), results_(results), callbacks_(callbacks) {
    for (const SweepCell& cell : all_cells(axes_)) {
      if (!results_.contains(cell)) missing_.push_back(cell);
    }
  }

  /// Runs the missing cells; false if the user stopped it.
  bool run() {
    if (missing_.empty()) return true;
    if (!input_.settings.every) choose_every();
    // The axes' order need not keep cells with one cost matrix together, so they are sorted.
    std::ranges::stable_sort(missing_, {}, [&](const SweepCell& cell) { return matrix_key(cell); });
    std::optional<Sampled> sampled;
    std::string sampled_for;
    for (std::size_t begin = 0; begin < missing_.size();) {
      std::size_t end = begin;
      while (end < missing_.size() && enhanced_key(missing_[end]) == enhanced_key(missing_[begin])) ++end;
      if (begin == 0 || sampled_for != matrix_key(missing_[begin])) {
        sampled_for = matrix_key(missing_[begin]);
        sampled = sample_or_warn(missing_[begin]);
      }
      if (!run_together(sampled, begin, end)) return false;
      begin = end;
    }
    return true;
  }

 private:
  /// The settings given in a cell that have an effect there.
  [[nodiscard]] Settings settings(const SweepCell& cell) const {
    Settings given = settings_at(input_.settings, axes_, cell);
    if (given.motion == "none" && every_ > 0) given.every = every_;
    given.view_points.reset();  // a sweep asks where places were found only
    given.verify.reset();
    const Settings resolved = resolve(given, {.pass_over = true});
    for (const Setting& setting : settings_table())
      if (!text_of(resolved, setting)) reset(given, setting);
    return given;
  }

  /// The options of a cell's stages.
  [[nodiscard]] StageOptions stages(const SweepCell& cell) const {
    return stage_options(resolve(settings(cell), {}));
  }

  /// The values in a cell that its cost matrix depends on.
  [[nodiscard]] std::string matrix_key(const SweepCell& cell) const {
    std::string key;
    for (std::size_t i = 0; i < axes_.size(); ++i) {
      if (shapes_the_matrix(axes_[i].setting)) key += cell[i] + "\n";
    }
    return key;
  }

  /// The same for the enhanced one.
  [[nodiscard]] std::string enhanced_key(const SweepCell& cell) const {
    std::string key = matrix_key(cell);
    for (std::size_t i = 0; i < axes_.size(); ++i) {
      if (axes_[i].setting.starts_with("enhance")) key += cell[i] + "\n";
    }
    return key;
  }

  /// Both walks, with what a cell's descriptor keeps of them; read once for each descriptor.
  const Walks& walks(const SweepCell& cell) {
    const std::string descriptor = settings(cell).descriptor.value_or("");
    const auto known = walks_.find(descriptor);
    if (known != walks_.end()) return known->second;
    vo::WalkOptions walk = stages(cell).walk;
    walk.preview_width_px = 0;
    for (const SweepCell& other : missing_) {  // everything that any of them needs
      const vo::WalkOptions needed = stages(other).walk;
      walk.track_features |= needed.track_features;
      walk.visual_odometry |= needed.visual_odometry;
    }
    Walks& both = walks_[descriptor];
    both.reference = input_.reference(walk);
    both.query = input_.query(walk);
    return both;
  }

  /// Without motion, as many keyframes as the first motion gives.
  void choose_every() {
    const std::vector<SweepCell> cells = all_cells(axes_);
    if (std::ranges::find(axes_, "every", &SweepAxis::setting) != axes_.end() ||
        std::ranges::none_of(cells, [&](const SweepCell& cell) { return settings(cell).motion == "none"; }))
      return;
    for (const SweepCell& cell : cells) {
      const Settings with_motion = settings(cell);
      if (with_motion.motion == "none") continue;
      every_ = every_like(walks(cell), with_motion);
      return;
    }
  }

  std::optional<Sampled> sample_or_warn(const SweepCell& cell) {
    try {
      return sample(walks(cell), settings(cell));
    } catch (const vo::Error& error) {
      if (callbacks_.warn) callbacks_.warn(axes_.front().setting + " " + cell.front() + ": " + error.what());
      return {};
    }
  }

  /// The missing cells from `begin` to `end`, which share one enhanced matrix.
  bool run_together(const std::optional<Sampled>& sampled, std::size_t begin, std::size_t end) {
    CostMatrix enhanced;
    if (sampled) {
      enhanced = sampled->cost;
      const RouteMatchingOptions matching = stages(missing_[begin]).matching;
      ContrastEnhancementOptions enhancement = matching.enhancement;
      enhancement.prior_queries = prior_queries_of(matching);
      enhance_contrast(enhanced, enhancement);
    }
    const std::size_t together = 4 * static_cast<std::size_t>(vo::thread_count());
    for (; begin < end; begin += together) {
      const std::size_t count = std::min(together, end - begin);
      std::vector<std::optional<CellResult>> found(count);
      if (sampled) {
        vo::parallel_for(count, [&](std::size_t i) {
          found[i] = run_cell(*sampled, enhanced, stages(missing_[begin + i]).matching, input_.truth,
                              input_.tolerance);
        });
      }
      for (std::size_t i = 0; i < count; ++i) results_[missing_[begin + i]] = found[i];
      if (callbacks_.keep) callbacks_.keep(results_);
      if (callbacks_.progress && !callbacks_.progress({.stage = "sweeping",
                                                       .done = static_cast<std::int64_t>(begin + count),
                                                       .total = static_cast<std::int64_t>(missing_.size())}))
        return false;
    }
    return true;
  }

  const SweepInput& input_;
  const std::vector<SweepAxis>& axes_;
  SweepResults& results_;
  const SweepCallbacks& callbacks_;
  std::vector<SweepCell> missing_;
  std::map<std::string, Walks> walks_;  ///< by descriptor
  int every_ = 0;                       ///< frames between keyframes without motion; 0: as the settings say
};

}  // namespace

void check_sweep(const Settings& base, const std::vector<SweepAxis>& axes) {
  Settings with_effect;
  for (const SweepCell& cell : all_cells(axes))
    with_effect = merged(with_effect, resolve(settings_at(base, axes, cell), {.pass_over = true}));
  for (const Setting& setting : settings_table()) {
    if (text_of(base, setting) && !text_of(with_effect, setting))
      throw vo::Error(std::string(setting.name), "has no effect in any cell of this sweep",
                      "other axes, or this setting left out");
  }
}

bool sweep(const SweepInput& input, const std::vector<SweepAxis>& axes, SweepResults& results,
           const SweepCallbacks& callbacks) {
  check_sweep(input.settings, axes);
  return Sweep(input, axes, results, callbacks).run();
}

}  // namespace place
