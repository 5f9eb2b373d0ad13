#include "support/temporary_folder.hpp"

#include <optional>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <place/resolve.hpp>
#include <place/route/route.hpp>
#include <place/stage_options.hpp>
#include <vo/base/error.hpp>

namespace {

using place::Purpose;
using place::ResolveContext;
using place::Settings;

constexpr ResolveContext kRoute{.purpose = Purpose::kRoute};
constexpr ResolveContext kOdometry{.purpose = Purpose::kOdometry};

void expect_refused(const Settings& settings, const ResolveContext& context, const std::string& said) {
  EXPECT_THROW_WITH(place::resolve(settings, context), vo::Error, said);
}

/// What a route that was built with some settings has.
Settings route_of(const Settings& settings) {
  return place::kept_by_route(settings, place::resolve(settings, kRoute));
}

TEST(Resolve, FillsInEveryDefault) {
  const Settings resolved = place::resolve({}, {});
  EXPECT_EQ(resolved.motion, "sad");
  EXPECT_EQ(resolved.sampling_n, 6);
  EXPECT_FALSE(resolved.spacing_m);
  EXPECT_FALSE(resolved.every);    // has no effect
  EXPECT_FALSE(resolved.fov_deg);  // no steps are followed
  EXPECT_EQ(resolved.sequence_length, 10);
  EXPECT_EQ(resolved.search, "path");
  EXPECT_EQ(resolved.accept_probability, 0.95);
  EXPECT_FALSE(resolved.accept_score);  // only one of both is asked for
}

TEST(Resolve, PointsAreSeenThroughACamera) {
  Settings points;
  points.view_points = true;
  points.fov_deg = 90;
  EXPECT_EQ(place::resolve(points, kRoute).fov_deg, 90);
  EXPECT_FALSE(place::resolve(points, {.purpose = Purpose::kOdometry}).view_points);
  const Settings route = route_of(points);
  EXPECT_EQ(route.view_points, true);

  Settings query;
  EXPECT_EQ(place::resolve(query, {.route = &route}).verify, 0);
  EXPECT_FALSE(place::resolve(query, {.route = &route}).fov_deg);  // nobody looks again
  EXPECT_TRUE(place::stage_options(place::resolve(query, {.route = &route})).walk.recorders.size() == 1);
  query.verify = 5;
  EXPECT_EQ(place::resolve(query, {.route = &route}).fov_deg, 90);
  const place::StageOptions stages = place::stage_options(place::resolve(query, {.route = &route}));
  EXPECT_EQ(stages.verify, 5);
  EXPECT_EQ(stages.sampling.points_record, 1U);
  EXPECT_EQ(stages.walk.recorders.size(), 2U);
  EXPECT_EQ(place::stage_options(place::resolve(points, kRoute)).walk.recorders.size(), 2U);
  query.view_points = false;
  EXPECT_THROW(place::resolve(query, {.route = &route}), vo::Error);
}

TEST(Resolve, AgainChangesNothing) {
  std::vector<Settings> all(9);
  all[8].motion = "auto";
  all[1].motion = "steps";
  all[2].motion = "hybrid";
  all[3].motion = "hybrid";
  all[3].spacing_m = 0.5;
  all[4].motion = "steps";
  all[4].sampling_n = 3;
  all[5].motion = "none";
  all[5].every = 4;
  all[6].compat = "openseqslam";
  all[7].v_min = 0.9;
  all[7].v_max = 1.1;
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (const Purpose purpose : {Purpose::kRoute, Purpose::kLocalise}) {
      const Settings once = place::resolve(all[i], {.purpose = purpose});
      EXPECT_EQ(place::resolve(once, {.purpose = purpose}), once) << i;
      const Settings route = route_of(all[i]);
      const Settings on_route = place::resolve({}, {.route = &route, .route_has_poses = true});
      EXPECT_EQ(place::resolve(on_route, {.route = &route, .route_has_poses = true}), on_route) << i;
    }
  }
}

TEST(Resolve, RefusesWhatHasNoEffect) {
  Settings every;
  every.every = 3;
  expect_refused(every, {}, "every: has no effect: motion is sad");
  Settings spacing;
  spacing.spacing_m = 0.5;
  expect_refused(spacing, {}, "spacing-m: has no effect: motion is sad");
  Settings separations;
  separations.motion = "hybrid";
  separations.separations = 1;
  expect_refused(separations, {}, "separations: has no effect: motion is hybrid");
  Settings step;
  step.motion = "steps";
  step.step_signal = "bounce";
  step.min_step_deg = 1;
  expect_refused(step, {}, "min-step-deg: has no effect: step-signal is bounce");
  Settings range;
  range.compat = "openseqslam";
  range.search_range_rad = 0.2;
  expect_refused(range, {}, "search-range-rad: has no effect: compat is openseqslam");
  Settings window;
  window.enhance_window = 20;
  expect_refused(window, {}, "enhance-window: has no effect: enhance is standardise");
  window.compat = "openseqslam";
  EXPECT_EQ(place::resolve(window, {}).enhance_window, 20);  // the original's R
  Settings step_length;
  step_length.step_length = 0.6;
  expect_refused(step_length, kRoute, "step-length: has no effect: motion is sad, so no steps are followed");
  EXPECT_EQ(place::resolve(step_length, kOdometry).step_length, 0.6);
  EXPECT_EQ(place::resolve(step_length, {.route_has_poses = true}).step_length, 0.6);
  step_length.correct_drift = false;
  expect_refused(step_length, {.route_has_poses = true}, "step-length: has no effect");
  Settings height;
  height.camera_height_m = 1.6;
  expect_refused(height, kRoute, "camera-height-m: has no effect: motion is sad");
}

TEST(Resolve, PassesOverGroupsThatThePurposeDoesNotHave) {
  Settings search;
  search.sequence_length = 20;
  search.search_range_rad = 0.3;
  EXPECT_FALSE(place::resolve(search, kRoute).sequence_length);
  // But the route keeps them, for the walks that are found on it.
  const Settings route = route_of(search);
  EXPECT_EQ(place::resolve({}, {.route = &route}).sequence_length, 20);
}

TEST(Resolve, PassesOverWhatHasNoEffectIfAsked) {
  Settings settings;
  settings.motion = "none";
  settings.sampling_n = 3;
  const Settings resolved = place::resolve(settings, {.drop_ineffective = true});
  EXPECT_FALSE(resolved.sampling_n);
  EXPECT_EQ(resolved.every, 1);
}

TEST(Resolve, AWalkHasWhatItsRouteWasBuiltWith) {
  Settings built;
  built.motion = "steps";
  built.thumbnail_width = 32;
  built.spacing_m = 0.5;
  built.fov_deg = 90;
  built.threads = 3;
  const Settings route = route_of(built);
  const Settings resolved = place::resolve({}, {.route = &route});
  EXPECT_EQ(resolved.motion, "steps");
  EXPECT_EQ(resolved.thumbnail_width, 32);
  EXPECT_EQ(resolved.spacing_m, 0.5);
  EXPECT_EQ(resolved.fov_deg, 90);
  EXPECT_EQ(resolved.threads, 0);  // each walk's own
}

TEST(Resolve, RefusesOtherDescriptorsThanTheRoutes) {
  Settings built;
  built.patch_px = 4;
  const Settings route = route_of(built);
  Settings query;
  query.patch_px = 4;
  EXPECT_NO_THROW(place::resolve(query, {.route = &route}));
  query.patch_px = 8;
  expect_refused(query, {.route = &route}, "patch-px: is 8 and the route was built with 4");
}

TEST(Resolve, AModelMayHaveMovedSinceTheRouteWasBuilt) {
  Settings built;
  built.descriptor = "network";
  built.model = "/somewhere/net.onnx";
  const Settings route = route_of(built);
  EXPECT_EQ(place::resolve({}, {.route = &route}).model, "/somewhere/net.onnx");
  Settings query;
  query.model = "here/net.onnx";
  EXPECT_EQ(place::resolve(query, {.route = &route}).model, "here/net.onnx");
}

TEST(Resolve, AQueryHasTheRoutesMotionOrNone) {
  const Settings route = route_of({});
  Settings query;
  query.motion = "steps";
  expect_refused(query, {.route = &route}, "motion: is steps and the route was sampled by sad");
  query.motion = "none";
  query.every = 5;
  const Settings resolved = place::resolve(query, {.route = &route});
  EXPECT_EQ(resolved.every, 5);
  EXPECT_FALSE(resolved.sampling_n);
}

TEST(Resolve, KeyframesAreAsDenseAsGiven) {
  const auto density = [](std::optional<std::string> motion, std::optional<double> n,
                          std::optional<double> spacing_m) {
    Settings settings;
    settings.motion = std::move(motion);
    settings.sampling_n = n;
    settings.spacing_m = spacing_m;
    const Settings resolved = place::resolve(settings, kRoute);
    return std::pair(resolved.sampling_n, resolved.spacing_m);
  };
  using Pair = std::pair<std::optional<double>, std::optional<double>>;
  EXPECT_EQ(density("sad", {}, {}), Pair(6, std::nullopt));
  EXPECT_EQ(density("sad", 3, {}), Pair(3, std::nullopt));
  EXPECT_EQ(density("steps", {}, {}), Pair(std::nullopt, 0.85));
  EXPECT_EQ(density("steps", 3, {}), Pair(3, std::nullopt));
  EXPECT_EQ(density("steps", {}, 0.5), Pair(std::nullopt, 0.5));
  EXPECT_EQ(density("hybrid", {}, {}), Pair(6, 0.85));  // by whether steps are seen
  EXPECT_EQ(density("hybrid", 3, {}), Pair(3, std::nullopt));
  EXPECT_EQ(density("hybrid", {}, 0.5), Pair(std::nullopt, 0.5));
  EXPECT_EQ(density("hybrid", 3, 0.5), Pair(3, 0.5));
}

TEST(Resolve, AQuerysOwnDensityStandsForBothOfTheRoutes) {
  Settings built;
  built.motion = "hybrid";
  const Settings route = route_of(built);
  Settings query;
  query.sampling_n = 3;
  const Settings resolved = place::resolve(query, {.route = &route});
  EXPECT_EQ(resolved.sampling_n, 3);
  EXPECT_FALSE(resolved.spacing_m);
}

TEST(Resolve, SettingsThatGoTogether) {
  Settings settings;
  settings.v_min = 0.8;
  expect_refused(settings, {}, "v-max: is missing");
  settings.v_max = 0.7;
  expect_refused(settings, {}, "v-min: is 0.8 and v-max 0.7");
  settings.v_max = 1.2;
  EXPECT_FALSE(place::resolve(settings, {}).search_range_rad);
  settings.search_range_rad = 0.1;
  expect_refused(settings, {}, "search-range-rad: has no effect: v-min is given");

  Settings file;
  file.motion = "file";
  expect_refused(file, kRoute, "motion-file: is missing");
  file.motion = "sad";
  file.motion_file = "a.tum";
  expect_refused(file, kRoute, "motion-file: has no effect: motion is sad");

  Settings shift;
  shift.max_shift_px = 32;
  for (const char* thumbnails : {"thumbnail", "blocks+thumbnail"}) {
    shift.descriptor = thumbnails;
    expect_refused(shift, {}, "max-shift-px: is 32; expected less than 32, half of a picture's width");
  }
  shift.descriptor = "blocks";
  EXPECT_EQ(place::resolve(shift, {}).max_shift_px, 32);

  Settings camera;
  camera.motion = "steps";
  camera.camera = "c.yaml";
  camera.fov_deg = 70;
  expect_refused(camera, kRoute, "fov-deg: has no effect: camera is given");

  Settings length;
  length.sequence_length = 10;
  length.sequence_length_m = 8;
  expect_refused(length, {}, "sequence-length: has no effect: sequence-length-m is given");
}

TEST(Resolve, TheOriginalsScoreHasAThresholdOfItsOwn) {
  Settings settings;
  settings.compat = "openseqslam";
  EXPECT_EQ(place::resolve(settings, {}).accept_score, 0.1);
  EXPECT_FALSE(place::resolve(settings, {}).accept_probability);  // it has none
  settings.accept_score = 0.7;
  EXPECT_EQ(place::resolve(settings, {}).accept_score, 0.7);
}

TEST(Resolve, AScoreToAcceptByTakesTheProbabilitysPlace) {
  Settings settings;
  settings.accept_score = 2;
  EXPECT_FALSE(place::resolve(settings, {}).accept_probability);
  settings.accept_probability = 0.9;
  expect_refused(settings, {}, "accept-probability: has no effect: accept-score is given");
}

TEST(Resolve, WhatConcernsLinesIsRefusedOfOtherSearches) {
  Settings settings;
  settings.min_fraction = 0.8;
  expect_refused(settings, {}, "min-fraction: has no effect: search is path");
  settings.search = "cone";
  EXPECT_EQ(place::resolve(settings, {}).min_fraction, 0.8);
  Settings graph;
  graph.search = "graph";
  graph.search_range_rad = 0.2;
  expect_refused(graph, {}, "search-range-rad: has no effect: search is graph");
  Settings original;
  original.compat = "openseqslam";
  original.search = "path";
  expect_refused(original, {}, "search: has no effect: compat is openseqslam");
}

TEST(Resolve, OdometryIsByStepsOrHybrid) {
  EXPECT_EQ(place::resolve({}, kOdometry).motion, "hybrid");
  Settings settings;
  settings.motion = "steps";
  EXPECT_FALSE(place::resolve(settings, kOdometry).spacing_m);  // no keyframes are made
  settings.motion = "sad";
  expect_refused(settings, kOdometry, "motion: is sad; expected hybrid or steps");
}

TEST(Resolve, AutomaticMotionIsTheRoutesOnARoute) {
  Settings automatic;
  automatic.motion = "auto";
  const Settings resolved = place::resolve(automatic, kRoute);
  EXPECT_EQ(resolved.motion, "auto");  // until a walk is seen
  EXPECT_EQ(resolved.spacing_m, 0.85);
  EXPECT_EQ(resolved.sampling_n, 6);
  EXPECT_EQ(resolved.step_length, 0.7);  // steps are followed, to see whether there are any
  EXPECT_TRUE(place::stage_options(resolved).walk.track_features);
  EXPECT_EQ(place::resolve(automatic, kOdometry).motion, "hybrid");
  for (const char* const motion : {"steps", "sad", "none"}) {
    Settings built;
    built.motion = motion;
    const Settings route = route_of(built);
    EXPECT_EQ(place::resolve(automatic, {.route = &route}), place::resolve({}, {.route = &route})) << motion;
  }
}

TEST(StageOptions, APartOfThePicturesAndAMask) {
  Settings settings;
  settings.crop = "16,0,64,40";
  settings.mask = "bonnet.png";
  settings.frame_rate_hz = 12.5;
  const vo::FrameSourceOptions frames = place::stage_options(settings).walk.frames;
  EXPECT_EQ(frames.crop, cv::Rect(16, 0, 64, 40));
  EXPECT_EQ(frames.mask, "bonnet.png");
  EXPECT_EQ(frames.frame_rate_hz, 12.5);
  for (const char* const bad : {"16,0,64", "16,0,64,40,1", "16;0;64;40", "-1,0,64,40", "0,0,0,40"}) {
    settings.crop = bad;
    EXPECT_THROW(place::stage_options(settings), vo::Error) << bad;
  }
}

TEST(StageOptions, ATrajectoryOfMotionAndOneOfASurveyAreReadAlike) {
  Settings settings;
  EXPECT_FALSE(place::survey_options(settings).max_gap_s);
  settings.axes = "camera";
  settings.motion_file_gap_s = 5;
  EXPECT_EQ(place::survey_options(settings).axes, vo::TrajectoryAxes::kCamera);
  EXPECT_EQ(place::survey_options(settings).max_gap_s, 5);
  EXPECT_EQ(place::stage_options(settings).motion_file_form.axes, vo::TrajectoryAxes::kCamera);
  EXPECT_EQ(place::stage_options(settings).motion_file_fit.max_gap_s, 5);
}

/// A default of the table is the stage's own, so that a caller of the stage by itself gets the same.
TEST(StageOptions, DefaultsAreThoseOfTheStages) {
  const place::StageOptions resolved = place::stage_options(place::resolve({}, {.route_has_poses = true}));
  const place::StageOptions stages;
  EXPECT_EQ(resolved.walk.thumbnail.width, stages.walk.thumbnail.width);
  EXPECT_EQ(resolved.walk.thumbnail.height, stages.walk.thumbnail.height);
  EXPECT_EQ(resolved.walk.preview_width_px, stages.walk.preview_width_px);
  EXPECT_EQ(resolved.walk.frames.frame_rate_hz, stages.walk.frames.frame_rate_hz);
  EXPECT_EQ(resolved.walk.tracker.fov_deg, stages.walk.tracker.fov_deg);
  EXPECT_EQ(resolved.walk.vo.fov_deg, stages.walk.vo.fov_deg);
  EXPECT_EQ(resolved.walk.tracker.width_px, stages.walk.tracker.width_px);
  EXPECT_EQ(resolved.walk.tracker.window, stages.walk.tracker.window);
  EXPECT_EQ(resolved.walk.tracker.motion.average, stages.walk.tracker.motion.average);
  EXPECT_EQ(resolved.walk.tracker.motion.heading.method, stages.walk.tracker.motion.heading.method);
  EXPECT_EQ(resolved.matching.patch.patch_px, stages.matching.patch.patch_px);
  EXPECT_EQ(resolved.matching.patch.shape, stages.matching.patch.shape);
  EXPECT_EQ(resolved.matching.patch.min_contrast, stages.matching.patch.min_contrast);
  EXPECT_EQ(resolved.sampling.source, stages.sampling.source);
  EXPECT_EQ(resolved.sampling.tie_scale, stages.sampling.tie_scale);
  const auto &visual = resolved.sampling.motion.visual, &own = stages.sampling.motion.visual;
  EXPECT_EQ(visual.model.separations, own.model.separations);
  EXPECT_EQ(visual.model.max_speed, own.model.max_speed);
  EXPECT_EQ(visual.model.local_window_s, own.model.local_window_s);
  EXPECT_EQ(visual.standing.span_s, own.standing.span_s);
  EXPECT_EQ(visual.alignment.high_error_mads, own.alignment.high_error_mads);
  const auto &gait = resolved.sampling.motion.pedestrian, &own_gait = stages.sampling.motion.pedestrian;
  EXPECT_EQ(gait.step_length.length_m, own_gait.step_length.length_m);
  EXPECT_EQ(gait.step_length.model, own_gait.step_length.model);
  EXPECT_EQ(gait.signal.lowpass.cutoff_hz, own_gait.signal.lowpass.cutoff_hz);
  EXPECT_EQ(gait.steps.signal, own_gait.steps.signal);
  EXPECT_EQ(resolved.matching.max_shift_px, stages.matching.max_shift_px);
  EXPECT_EQ(resolved.matching.enhancement.method, stages.matching.enhancement.method);
  EXPECT_EQ(resolved.matching.search.length, stages.matching.search.length);
  EXPECT_EQ(resolved.matching.search.search_range_rad, stages.matching.search.search_range_rad);
  EXPECT_EQ(resolved.matching.search.min_fraction, stages.matching.search.min_fraction);
  EXPECT_EQ(resolved.matching.search.uniqueness_window, stages.matching.search.uniqueness_window);
  EXPECT_EQ(resolved.matching.accept_score, stages.matching.accept_score);
  EXPECT_EQ(resolved.matching.accept_probability, stages.matching.accept_probability);
  EXPECT_EQ(resolved.matching.method, stages.matching.method);
  EXPECT_EQ(resolved.matching.fuse_traverses, stages.matching.fuse_traverses);
  EXPECT_EQ(resolved.matching.candidate_use, stages.matching.candidate_use);
  EXPECT_FALSE(resolved.matching.openseqslam);
}

TEST(StageOptions, OfThePublishedPedestrianMethod) {
  Settings settings;
  settings.motion = "steps";
  settings.step_signal = "pvo";
  settings.min_step_deg = 0;  // Fig. 3a
  const vo::PedestrianMotionOptions pvo =
      place::stage_options(place::resolve(settings, {})).sampling.motion.pedestrian;
  EXPECT_EQ(pvo.steps.signal, vo::StepSignal::kPublished);
  EXPECT_EQ(pvo.steps.detection.delta_min, 0);
  EXPECT_TRUE(pvo.dead_reckoning.as_published);
  EXPECT_GT(pvo.signal.heading_cutoff_hz, 0);
}

TEST(StageOptions, AreWhatSettingsSay) {
  Settings settings;
  settings.motion = "steps";
  settings.heading = "naive";
  settings.average = "mean";
  settings.step_length_model = "fixed";
  settings.step_signal = "orientation";
  settings.min_step_deg = 0.4;
  settings.fov_deg = 90;
  settings.compat = "openseqslam-mended";
  settings.v_min = 0.9;
  settings.v_max = 1.1;
  settings.patch_shape = "window";
  const place::StageOptions options = place::stage_options(place::resolve(settings, {}));
  EXPECT_EQ(options.sampling.source, vo::MotionSource::kSteps);
  EXPECT_TRUE(options.walk.track_features);
  EXPECT_FALSE(options.walk.visual_odometry);
  EXPECT_EQ(options.walk.tracker.motion.heading.method, vo::HeadingMethod::kNaive);
  EXPECT_EQ(options.walk.tracker.motion.average, vo::Average::kMean);
  EXPECT_EQ(options.walk.vo.fov_deg, 90);  // one camera
  EXPECT_EQ(options.sampling.motion.pedestrian.step_length.model, vo::StepLengthModel::kFixed);
  EXPECT_EQ(options.sampling.motion.pedestrian.steps.signal, vo::StepSignal::kOrientation);
  EXPECT_EQ(options.sampling.motion.pedestrian.steps.detection.delta_min, 0.4);
  EXPECT_EQ(options.sampling.motion.pedestrian.signal.heading_cutoff_hz, 0);  // the swing is left in
  EXPECT_FALSE(options.sampling.motion.pedestrian.dead_reckoning.as_published);
  EXPECT_EQ(options.sampling.motion.visual.patch.shape, vo::PatchShape::kWindow);
  ASSERT_TRUE(options.matching.openseqslam);
  EXPECT_FALSE(options.matching.openseqslam->quirks.constant_patch_is_zero);
  EXPECT_TRUE(options.matching.openseqslam->quirks.one_term_too_many);
  EXPECT_EQ(options.matching.openseqslam->v_min, 0.9);
  EXPECT_TRUE(place::stage_options(place::resolve({}, {}), true).walk.track_features);
}

TEST(Resolve, ARatioIsOfWholeLines) {
  Settings settings;
  settings.search = "lines";
  settings.score = "ratio";
  expect_refused(settings, {}, "score: is ratio, which part of a line has none of; expected min-fraction 1");
  settings.min_fraction = 1;
  EXPECT_EQ(place::stage_options(place::resolve(settings, {})).matching.search.score,
            place::MatchScore::kRatio);
  settings.search = "path";
  settings.min_fraction.reset();
  expect_refused(settings, {}, "score: has no effect: search is path");
}

TEST(Resolve, AFileWithoutAUnitIsSampledByEq4) {
  Settings settings;
  settings.motion = "file";
  settings.motion_file = "camera.tum";
  settings.motion_file_unit = "none";
  const Settings resolved = place::resolve(settings, {});
  EXPECT_EQ(resolved.sampling_n, 6);
  EXPECT_FALSE(resolved.spacing_m);
  EXPECT_FALSE(place::stage_options(resolved).motion_file_fit.metric);
  EXPECT_EQ(place::resolve(resolved, {}), resolved);
  settings.spacing_m = 1;
  expect_refused(settings, {}, "spacing-m: has no effect: motion-file-unit is none");
  settings.motion_file_unit.reset();
  EXPECT_TRUE(place::stage_options(place::resolve(settings, {})).motion_file_fit.metric);
}

TEST(Resolve, KnowsWhatARouteHas) {
  place::Route route;
  route.settings.descriptor = "hog";
  Settings verifies;
  verifies.verify = 5;
  EXPECT_EQ(place::resolve({}, place::on_route(route)).descriptor, "hog");
  expect_refused(verifies, place::on_route(route), "verify");  // no points to check with
  place::Traverse& traverse = route.traverses.emplace_back();
  traverse.view_points.emplace_back();
  EXPECT_EQ(place::resolve(verifies, place::on_route(route)).verify, 5);
  EXPECT_FALSE(place::follows_steps({}, place::on_route(route)));
  traverse.keyframes.emplace_back().pose = vo::Pose2{};
  const ResolveContext with_poses = place::on_route(route);
  EXPECT_TRUE(place::follows_steps({}, with_poses));
  EXPECT_EQ(place::on_route(route, Purpose::kRoute).purpose, Purpose::kRoute);
}

TEST(Resolve, PatchesFillTheThumbnail) {
  Settings settings;
  settings.thumbnail_height = 36;
  expect_refused(settings, kRoute, "patch-px: is 8 and a side of the thumbnail 36");
  settings.patch_shape = "window";
  EXPECT_NO_THROW(place::resolve(settings, kRoute));
}

}  // namespace
