#include "place/evaluation/sweep.hpp"

#include "evaluation/sweep_cell.hpp"
#include "match/traverse_costs.hpp"
#include "place/place.hpp"
#include "place/stage_options.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include <vo/base/error.hpp>
#include <vo/base/parallel.hpp>

namespace place {
namespace {

/// Frames between keyframes with which there are about as many as in a sampling.
int every_like(const WalkPair& walks, const SampledPair& sampled) {
  const auto frames = static_cast<double>(walks.query.frames() + walks.reference.frames());
  return std::max(1, static_cast<int>(std::lround(frames / static_cast<double>(keyframes_of(sampled)))));
}

/// A sweep in progress: what remains, what is done, and where it is kept.
class Sweep {
 public:
  Sweep(const SweepInput& input, const std::vector<SweepAxis>& axes, const std::vector<SweepCell>& cells,
        SweepResults& results, const SweepCallbacks& callbacks)
      : input_(input), axes_(axes), results_(results), callbacks_(callbacks) {
    for (const SweepCell& cell : cells) {
      if (!results_.contains(cell) && std::ranges::find(missing_, cell) == missing_.end())
        missing_.push_back(cell);
    }
  }

  /// Runs the missing cells; false if the user stopped it.
  bool run() {
    if (missing_.empty()) return true;
    choose_densities();
    // The axes' order need not keep cells with the same walks and matrix together, so they are sorted.
    std::ranges::stable_sort(missing_, {}, [&](const SweepCell& cell) {
      return std::tuple(reading_key(cell), matrix_key(cell), enhanced_key(cell));
    });
    std::optional<SampledPair> sampled;
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
    const Settings resolved = resolve(given, {.drop_ineffective = true});
    for (const Setting& setting : settings_table())
      if (!text_of(resolved, setting)) reset(given, setting);
    return given;
  }

  /// The options of a cell's stages.
  [[nodiscard]] StageOptions stages(const SweepCell& cell) const {
    return stage_options(resolve(settings(cell), {}));
  }

  /// The values in a cell of the axes that fulfil a condition.
  template <typename Condition>
  [[nodiscard]] std::string key(const SweepCell& cell, const Condition& counts) const {
    std::string key;
    for (std::size_t i = 0; i < axes_.size(); ++i) {
      if (counts(axes_[i].setting)) key += cell[i] + "\n";
    }
    return key;
  }

  /// The values that affect what is kept of the walks.
  [[nodiscard]] std::string reading_key(const SweepCell& cell) const {
    return key(cell, [](const std::string& name) { return setting_named(name).at_reading; });
  }

  /// Those that its cost matrix depends on.
  [[nodiscard]] std::string matrix_key(const SweepCell& cell) const { return key(cell, shapes_the_matrix); }

  /// The same for the enhanced one.
  [[nodiscard]] std::string enhanced_key(const SweepCell& cell) const {
    return key(
        cell, [](const std::string& name) { return shapes_the_matrix(name) || name.starts_with("enhance"); });
  }

  /// Both walks, as a cell needs them; read once for all cells that need the same.
  const WalkPair& walks(const SweepCell& cell) {
    const std::string wanted = reading_key(cell);
    if (walks_ && read_for_ == wanted) return *walks_;
    vo::WalkOptions walk = stages(cell).walk;
    walk.preview_width_px = 0;
    for (const SweepCell& other : all_cells(axes_)) {  // everything that any of them needs
      if (reading_key(other) != wanted) continue;
      const vo::WalkOptions needed = stages(other).walk;
      // Settings of what a cell does not do have no effect on it, and are not among its options.
      if (needed.track_features && !walk.track_features) walk.tracker = needed.tracker;
      if (needed.visual_odometry && !walk.visual_odometry) walk.vo = needed.vo;
      walk.track_features |= needed.track_features;
      walk.visual_odometry |= needed.visual_odometry;
    }
    walks_.reset();
    read_for_ = wanted;
    vo::Walk reference = input_.reference(walk);
    walks_ = WalkPair{.query = input_.query(walk), .reference = std::move(reference)};
    return *walks_;
  }

  /// Without motion, as many keyframes as the first motion gives; if densities are to be equal, the number of
  /// keyframes that all of them have.
  void choose_densities() {
    const std::vector<SweepCell> cells = all_cells(axes_);
    const auto is_fixed = [&](const SweepCell& cell) { return settings(cell).motion == "none"; };
    const auto fixed = std::ranges::find_if(cells, is_fixed);
    const auto with_motion = std::ranges::find_if_not(cells, is_fixed);
    const bool every_varies = std::ranges::find(axes_, "every", &SweepAxis::setting) != axes_.end();
    const bool choose =
        fixed != cells.end() && with_motion != cells.end() && !input_.settings.every && !every_varies;
    if (choose) every_ = every_like(walks(*with_motion), sample(*with_motion));
    if (input_.equal_keyframes) target_ = keyframes_of(sample(fixed != cells.end() ? *fixed : cells.front()));
  }

  SampledPair sample(const SweepCell& cell) {
    if (target_ == 0) return sample_pair(walks(cell), settings(cell), input_.truth);
    return sample_equally(walks(cell), settings(cell), input_.truth, target_);
  }

  std::optional<SampledPair> sample_or_warn(const SweepCell& cell) {
    walks(cell);  // a walk that cannot be read is no cell that cannot be run
    try {
      return sample(cell);
    } catch (const vo::Error& error) {
      if (callbacks_.warn) callbacks_.warn(axes_.front().setting + " " + cell.front() + ": " + error.what());
      return {};
    }
  }

  /// The missing cells from `begin` to `end`, which share one enhanced matrix.
  bool run_together(const std::optional<SampledPair>& sampled, std::size_t begin, std::size_t end) {
    CostMatrix enhanced;
    if (sampled) {
      TraverseCosts costs{{}, sampled->cost};
      enhance_compared(costs, 0, stages(missing_[begin]).matching, {});
      enhanced = std::move(costs.enhanced);
    }
    const std::size_t together = 4 * static_cast<std::size_t>(vo::thread_count());
    for (; begin < end; begin += together) {
      const std::size_t count = std::min(together, end - begin);
      std::vector<std::optional<CellResult>> found(count);
      if (sampled) {
        vo::parallel_for(count, [&](std::size_t i) {
          found[i] = run_cell(*sampled, enhanced, stages(missing_[begin + i]).matching, *walks_, input_.truth,
                              input_.tolerance);
        });
      }
      for (std::size_t i = 0; i < count; ++i) results_[missing_[begin + i]] = std::move(found[i]);
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
  std::optional<WalkPair> walks_;
  std::string read_for_;    ///< the reading key of the walks
  int every_ = 0;           ///< frames between keyframes without motion; 0: as the settings say
  std::size_t target_ = 0;  ///< keyframes that every sampling has; 0: as the settings say
};

}  // namespace

void check_sweep(const Settings& base, const std::vector<SweepAxis>& axes, bool equal_keyframes) {
  Settings with_effect;
  for (const SweepCell& cell : all_cells(axes))
    with_effect = merged(with_effect, resolve(settings_at(base, axes, cell), {.drop_ineffective = true}));
  for (const Setting& setting : settings_table()) {
    if (text_of(base, setting) && !text_of(with_effect, setting))
      throw vo::Error(std::string(setting.name), "has no effect in any cell of this sweep",
                      "other axes, or this setting left out");
  }
  if (!equal_keyframes) return;
  const auto samples_apart = [](const SweepAxis& axis) {
    const SettingGroup group = setting_named(axis.setting).group;
    return axis.values.size() > 1 && group != SettingGroup::kSearch && group != SettingGroup::kDescribing;
  };
  if (std::ranges::none_of(axes, samples_apart))
    throw vo::Error("equal-keyframes", "has no effect: nothing that samples walks is varied", "it left out");
  for (const char* const density : {"every", "sampling-n", "spacing-m"}) {
    if (std::ranges::find(axes, density, &SweepAxis::setting) != axes.end())
      throw vo::Error("equal-keyframes", fmt::format("sets {}, which is varied", density), "one of both");
  }
}

bool run_cells(const SweepInput& input, const std::vector<SweepAxis>& axes,
               const std::vector<SweepCell>& cells, SweepResults& results, const SweepCallbacks& callbacks) {
  check_sweep(input.settings, axes, input.equal_keyframes);
  return Sweep(input, axes, cells, results, callbacks).run();
}

bool sweep(const SweepInput& input, const std::vector<SweepAxis>& axes, SweepResults& results,
           const SweepCallbacks& callbacks) {
  return run_cells(input, axes, all_cells(axes), results, callbacks);
}

}  // namespace place
