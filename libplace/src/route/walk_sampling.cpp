#include "place/route/walk_sampling.hpp"

#include "place/match/descriptor_costs.hpp"
#include "place/match/walk_gaps.hpp"
#include "place/route/resampling.hpp"

#include <algorithm>
#include <filesystem>
#include <numeric>
#include <stdexcept>

#include <fmt/format.h>

#include <vo/base/error.hpp>
#include <vo/gait/playback.hpp>

namespace place {
namespace {

/// A warning if a walk's frames are too far apart for its motion to be learned well.
std::vector<std::string> motion_warnings(const vo::Walk& walk, const vo::MotionModel& model) {
  if (model.separation.back() >= kLeastCommonView_s) return {};
  return {
      fmt::format("{}: frames more than {:.2f} s apart have nothing in common, so motion is learned poorly; "
                  "a higher frame "
                  "rate, or motion none, may do better",
                  walk.source, model.separation.back())};
}

/// Where one walk is in metres and the other is not (steps were seen in one of them only), both are assumed
/// to have the same mean speed; `relative_scale` corrects the rest.
void to_mean_speed(const Traverse& reference, const vo::Walk& walk, std::vector<double>& displacement) {
  if (reference.keyframes.empty()) return;
  double duration_s = walk.time_s.back();
  for (const vo::ClockGap& gap : walk.gaps)
    if (vo::parts_walk(gap)) duration_s -= gap.length_s;
  const double there = reference.keyframes.back().displacement / reference.duration_s;
  const double here = std::accumulate(displacement.begin(), displacement.end(), 0.0) / duration_s;
  if (!(there > 0 && here > 0)) return;
  for (double& step : displacement) step *= there / here;
}

/// The displacement between keyframes.
double unit_of(const vo::Walk& walk, const SampledWalk& sampled, const WalkSamplingOptions& options,
               const Route* route) {
  const bool by_metres = sampled.metric && options.spacing_m;
  if (!by_metres && !options.n)
    throw std::invalid_argument("sample_walk: n expected, as the motion is not in metres");
  if (route == nullptr || route->traverses.empty())
    return by_metres ? *options.spacing_m
                     : sampling_unit(sampled.displacement, walk.time_s, *options.n);  // SSS Eq. 4
  const Settings& first = route->settings;
  if (by_metres) return options.spacing_m == first.spacing_m ? route->unit : *options.spacing_m;
  return first.sampling_n ? route->unit / *first.sampling_n * *options.n : route->unit;  // linear in n
}

std::shared_ptr<const DescriptorSet> descriptors_of(const WalkSamplingOptions& options) {
  if (options.descriptors) return options.descriptors;
  return make_descriptors({.name = "thumbnail", .patch = options.motion.visual.patch});
}

/// The first frames after the gaps that interrupt a walk.
std::vector<std::size_t> begins_of(const vo::Walk& walk) {
  std::vector<std::size_t> begins;
  for (const vo::ClockGap& gap : walk.gaps)
    if (vo::parts_walk(gap)) begins.push_back(gap.frame);
  return begins;
}

/// What was kept of the keyframes for each descriptor.
KeyframeRecords records_of(const vo::Walk& walk, const SampledWalk& sampled, const DescriptorSet& descriptors,
                           std::size_t index) {
  KeyframeRecords keyframes{
      .frames = sampled.frames, .time_s = {}, .thumbnails = sampled.thumbnails, .records = {}};
  for (const std::size_t frame : sampled.frames) keyframes.time_s.push_back(walk.time_s[frame]);
  if (!descriptors[index]->traits().records_frames) return keyframes;
  if (walk.records.size() < descriptors.size())
    throw std::invalid_argument("sample_walk: a walk read with the descriptors' recorders expected");
  for (const std::size_t frame : sampled.frames) keyframes.records.push_back(walk.records[index][frame]);
  return keyframes;
}

/// The points kept of the keyframes.
std::vector<Bytes> points_of(const vo::Walk& walk, const std::vector<std::size_t>& frames,
                             const std::optional<std::size_t>& record) {
  std::vector<Bytes> points;
  if (!record) return points;
  if (*record >= walk.records.size())
    throw std::invalid_argument("sample_walk: a walk read with its points recorded expected");
  for (const std::size_t frame : frames) points.push_back(walk.records[*record][frame]);
  return points;
}

/// Takes frames as keyframes and describes them. `route`: with traverses, or null.
void take_keyframes(const vo::Walk& walk, std::vector<std::size_t> frames, const DescriptorSet& descriptors,
                    const Route* route, SampledWalk& sampled) {
  sampled.frames = std::move(frames);
  sampled.thumbnails = vo::select(walk.thumbnails, sampled.frames);
  sampled.descriptors.clear();
  sampled.learned.clear();
  for (std::size_t i = 0; i < descriptors.size(); ++i) {
    const KeyframeRecords keyframes = records_of(walk, sampled, descriptors, i);
    sampled.learned.push_back(route != nullptr ? route->learned.at(i) : descriptors[i]->learn(keyframes));
    sampled.descriptors.push_back(descriptors[i]->describe(keyframes, sampled.learned.back()));
  }
}

/// The scale that fits keyframes to those of the traverse whose lines fit them best, by the first descriptor.
RelativeScale scale_to(const Route& route, const SampledWalk& sampled, const Descriptor& descriptor,
                       const RelativeScaleOptions& scale, const WalkSamplingOptions& options) {
  const Descriptors query = descriptor.comparable(sampled.descriptors.front());
  const DescriptorTraits traits = descriptor.traits();
  const ContrastEnhancementOptions enhancement{.method = Enhancement::kStandardise,
                                               .prior_queries = traits.prior_queries};
  const auto costs_on = [&](std::size_t traverse) {
    if (options.scale_costs) return options.scale_costs(traverse, query);
    Descriptors compared = descriptor.comparable(route.traverses[traverse].descriptors.front());
    if (count_of(compared) > kMostForScale) compared = select(compared, candidates(query, compared));
    return cost_matrix(*descriptor_costs(query, compared, traits, options.max_shift_px));
  };
  RelativeScale best;
  for (std::size_t t = 0; t < route.traverses.size(); ++t) {
    const RelativeScale fitted = relative_scale(costs_on(t), scale, enhancement);
    if (t == 0 || fitted.cost < best.cost) best = fitted;
  }
  return best;
}

/// `sample_walk` without its points.
SampledWalk described_walk(const vo::Walk& walk, const WalkSamplingOptions& options, const Route* route) {
  SampledWalk sampled;
  const std::shared_ptr<const DescriptorSet> descriptors = descriptors_of(options);
  const Route* const on = route != nullptr && !route->traverses.empty() ? route : nullptr;
  if (options.source == vo::MotionSource::kNone) {
    take_keyframes(walk, every_kth(walk.frames(), static_cast<std::size_t>(options.every)), *descriptors, on,
                   sampled);
    return sampled;
  }
  vo::WalkMotion motion = vo::walk_motion(walk, options.source, options.motion);
  const std::string why = motion.impossible_cadence_hz
                              ? ", and " + vo::impossible_cadence_text(*motion.impossible_cadence_hz)
                              : std::string();
  if (options.source == vo::MotionSource::kSteps && motion.pedestrian->detection.steps.empty())
    throw vo::Error(walk.source, "shows no steps" + why, "a walk on foot, or another motion");
  if (options.spacing_m && !options.n && !motion.metric)
    throw vo::Error(walk.source, "shows no steps, so its motion is not in metres" + why,
                    "no spacing-m, or a walk on foot");
  sampled.displacement = vo::displacements(motion);
  sampled.metric = motion.metric;
  sampled.warnings = motion.warnings;
  if (motion.metric) sampled.trajectory = std::move(motion.trajectory);
  if (motion.visual) {
    sampled.motion_model = std::move(motion.visual->model);
    for (std::string& warning : motion_warnings(walk, sampled.motion_model))
      sampled.warnings.push_back(std::move(warning));
  }
  const Traverse* reference = on != nullptr ? &on->traverses.front() : nullptr;
  if (reference != nullptr && motion.metric != route->metric)
    to_mean_speed(*reference, walk, sampled.displacement);
  sampled.unit = unit_of(walk, sampled, options, route);
  if (!(sampled.unit > 0))
    throw vo::Error(walk.source, "shows no motion", "a walk along which the scene changes");
  take_keyframes(walk, resample(sampled.displacement, sampled.unit, begins_of(walk)), *descriptors, on,
                 sampled);
  if (reference == nullptr || !options.tie_scale) return sampled;

  const RelativeScale tie =
      scale_to(*on, sampled, *descriptors->front(),
               motion.metric && route->metric ? options.metric_scale : options.relative_scale, options);
  sampled.scale_gain = tie.gain;
  if (tie.scale == 1) return sampled;
  sampled.scale = tie.scale;
  for (double& step : sampled.displacement) step *= sampled.scale;
  take_keyframes(walk, resample(sampled.displacement, sampled.unit, begins_of(walk)), *descriptors, on,
                 sampled);
  return sampled;
}

}  // namespace

SampledWalk sample_walk(const vo::Walk& walk, const WalkSamplingOptions& options, const Route* route) {
  SampledWalk sampled = described_walk(walk, options, route);
  sampled.view_points = points_of(walk, sampled.frames, options.points_record);
  return sampled;
}

Traverse make_traverse(const std::string& name, const vo::Walk& walk, const SampledWalk& sampled,
                       const std::optional<Survey>& survey) {
  if (survey && (survey->pose.size() != walk.frames() || survey->distance_m.size() != walk.frames())) {
    throw std::invalid_argument("make_traverse: the survey is of another number of frames than the walk");
  }
  Traverse traverse;
  traverse.name = name;
  traverse.source = std::filesystem::path(walk.source).filename().string();
  traverse.frames = static_cast<std::int64_t>(walk.frames());
  traverse.duration_s = walk.time_s.back();
  traverse.frame_width_px = walk.frame_width_px;
  traverse.frame_height_px = walk.frame_height_px;
  if (survey) traverse.pose_source = survey->source;
  if (survey) traverse.surveyed = survey->surveyed;
  traverse.descriptors = sampled.descriptors;
  traverse.view_points = sampled.view_points;
  const auto are_thumbnails = [](const Descriptors& made) {
    return std::holds_alternative<vo::ImageStack>(made);
  };
  if (!walk.previews.empty() && std::ranges::none_of(sampled.descriptors, are_thumbnails))
    traverse.thumbnails = sampled.thumbnails;
  const std::vector<std::size_t> gaps = gaps_at(sampled.frames, walk.time_s);
  double travelled = 0;
  std::size_t next = 0;
  for (const std::size_t frame : sampled.frames) {
    for (; next <= frame && next < sampled.displacement.size(); ++next)
      travelled += sampled.displacement[next];
    Keyframe keyframe;
    keyframe.frame = static_cast<std::int64_t>(frame);
    keyframe.time_s = walk.time_s[frame];
    keyframe.displacement = travelled;
    keyframe.after_gap = std::ranges::binary_search(gaps, traverse.keyframes.size());
    if (survey) keyframe.pose = survey->pose[frame];
    if (survey) keyframe.distance_m = survey->distance_m[frame];
    if (!walk.previews.empty()) keyframe.preview_jpeg = walk.previews[frame];
    traverse.keyframes.push_back(std::move(keyframe));
  }
  return traverse;
}

}  // namespace place
