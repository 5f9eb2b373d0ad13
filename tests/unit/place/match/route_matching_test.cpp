#include "support/known_walk.hpp"
#include "support/temporary_folder.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <place/match/route_matching.hpp>
#include <vo/base/error.hpp>
#include <vo/base/parallel.hpp>

namespace {

using namespace test_support;
using testing::SizeIs;

/// Share of the query keyframes found within `tolerance_px` of where they are.
double share_found(const place::RouteMatches& found, const KnownWalk& query, double tolerance_px) {
  std::size_t right = 0;
  for (const auto& match : found.matches) {
    if (!match.place) continue;
    const double true_px = query.place_px[static_cast<std::size_t>(match.query_frame)];
    right += std::abs(10 * *match.place->distance_m - true_px) <= tolerance_px ? 1 : 0;
  }
  return static_cast<double>(right) / static_cast<double>(found.matches.size());
}

/// Keeps the matrices of a search, whole.
struct Matrices {
  explicit Matrices(const place::Route& of) : route(of) {}

  void operator()(const place::SearchPart& part) {
    while (cost.size() <= part.traverse) {
      const std::size_t references = route.traverses[cost.size()].keyframes.size();
      for (auto* all : {&cost, &enhanced}) {
        all->push_back(place::make_cost_matrix(part.costs.queries, references));
        std::ranges::fill(all->back().values, std::numeric_limits<float>::infinity());
      }
    }
    place::CostMatrix& matrix = (part.enhanced ? enhanced : cost)[part.traverse];
    for (std::size_t q = 0; q < part.costs.queries; ++q) {
      for (std::size_t i = 0; i < part.costs.references; ++i)
        matrix.row(q)[part.references[part.costs.first_reference + i]] = part.costs.row(q)[i];
    }
  }

  const place::Route& route;
  std::vector<place::CostMatrix> cost, enhanced;
};

/// One traverse along the wall at 1/2 pixel a frame, sampled by motion.
class RouteMatchingTest : public testing::Test {
 protected:
  RouteMatchingTest() {
    add_traverse(route_, "by day", steady_walk(wall_, 0.5));
    options_.search.search_range_rad = 0.3;
    options_.method = "lines";
    options_.accept_score = 0.7;
  }
  Wall wall_{kWallPx, 1};
  place::Route route_;
  place::RouteMatchingOptions options_;
};

TEST_F(RouteMatchingTest, FindsAWalkAtAnotherSpeed) {
  // A part of the wall, at twice the speed and then at half.
  std::vector<double> speed_px(150, 1.0);
  speed_px.insert(speed_px.end(), 600, 0.25);
  const auto query = known_walk(wall_, places(101.3, speed_px));
  const auto sampled = sample_query(query, route_);
  Matrices matrices(route_);
  const auto found = place::match_on_route(route_, query.walk.time_s, sampled, options_, std::ref(matrices));
  ASSERT_EQ(found.matches.size(), sampled.frames.size());
  EXPECT_GT(found.matches.size(), 30U);
  EXPECT_EQ(found.sequence_length, 10);
  EXPECT_GT(found.lines, 1);
  // The costs that passed by are those of the stages by themselves.
  ASSERT_THAT(matrices.cost, SizeIs(1));
  place::CostMatrix costs =
      place::cost_matrix(vo::patch_normalise(sampled.thumbnails, options_.patch),
                         vo::patch_normalise(*place::thumbnails_of(route_.traverses[0]), options_.patch));
  EXPECT_EQ(matrices.cost[0].values, costs.values);
  place::enhance_contrast(costs, options_.enhancement);
  EXPECT_EQ(matrices.enhanced[0].values, costs.values);
  for (std::size_t q = 0; q < found.matches.size(); ++q) {
    const auto& match = found.matches[q];
    EXPECT_EQ(match.query_frame, static_cast<std::int64_t>(sampled.frames[q]));
    EXPECT_EQ(match.query_time_s, query.walk.time_s[sampled.frames[q]]);
    ASSERT_TRUE(match.place) << q;
    EXPECT_EQ(match.place->traverse, "by day");
    const auto& keyframe = route_.traverses[0].keyframes[match.place->keyframe];
    EXPECT_EQ(match.place->frame, keyframe.frame);
    EXPECT_EQ(match.place->time_s, keyframe.time_s);
    EXPECT_EQ(match.place->distance_m, keyframe.distance_m);
    EXPECT_EQ(match.accepted, match.score >= options_.accept_score);
  }
  // Keyframes of two walks lie at most half a spacing apart; a line of whole keyframes adds another half.
  // Where less than a whole line is inside, or the path bends because the speed changes (251.3 px, with half
  // a sequence on either side), a straight line is off by one more.
  const double spacing = spacing_px(route_.traverses[0]);
  for (const auto& match : found.matches) {
    const double true_px = query.place_px[static_cast<std::size_t>(match.query_frame)];
    const bool straight = !match.partial && std::abs(true_px - 251.3) > 5 * spacing;
    EXPECT_NEAR(10 * *match.place->distance_m, true_px, (straight ? 1 : 2) * spacing) << match.query_frame;
  }
}

TEST_F(RouteMatchingTest, FindsAWalkAmongCandidates) {
  const auto query = steady_walk(wall_, 0.5, 100, 300);
  const auto sampled = sample_query(query, route_);
  const auto exact = place::match_on_route(route_, query.walk.time_s, sampled, options_);
  options_.candidate_use = place::CandidateUse::kAlways;
  options_.candidates = {.sample = 8, .run = 8, .stretches = 1, .margin = 0};
  Matrices matrices(route_);
  const auto found = place::match_on_route(route_, query.walk.time_s, sampled, options_, std::ref(matrices));
  std::size_t unlike = 0, left_out = 0;
  for (std::size_t q = 0; q < exact.matches.size(); ++q)
    unlike += exact.matches[q].place->keyframe != found.matches[q].place->keyframe ? 1 : 0;
  EXPECT_LE(unlike, exact.matches.size() / 10);  // a neighbour where two are all but as good
  for (const float value : matrices.cost[0].values) left_out += std::isinf(value) ? 1 : 0;
  EXPECT_GT(left_out, 0U);
}

TEST_F(RouteMatchingTest, TheThresholdDecidesWhatIsAccepted) {
  const auto query = steady_walk(wall_, 0.5, 100, 300);
  const auto sampled = sample_query(query, route_);
  options_.accept_score = -1;
  for (const auto& match : place::match_on_route(route_, query.walk.time_s, sampled, options_).matches)
    EXPECT_TRUE(match.accepted);
  options_.accept_score = 1000;
  for (const auto& match : place::match_on_route(route_, query.walk.time_s, sampled, options_).matches)
    EXPECT_FALSE(match.accepted);
}

TEST_F(RouteMatchingTest, FlagsMatchesOnPartOfALineAtTheEnds) {
  const auto query = steady_walk(wall_, 0.5, 150, 400);
  const auto found = place::match_on_route(route_, query.walk.time_s, sample_query(query, route_), options_);
  // The walk lies well inside the reference, so only its own ends cut lines: terms are at -5 .. +4.
  const std::size_t count = found.matches.size();
  for (std::size_t q = 0; q < count; ++q) EXPECT_EQ(found.matches[q].partial, q < 5 || q + 4 >= count) << q;
}

TEST_F(RouteMatchingTest, TakesTheSurestOfSeveralTraverses) {
  // A traverse of another wall knows nothing of this one; one along only the second half knows that.
  add_traverse(route_, "elsewhere", steady_walk(Wall(kWallPx, 99), 0.5));
  add_traverse(route_, "second half", steady_walk(wall_, 0.4, kWallPx / 2.0));
  options_.fuse_traverses = false;
  const auto query = steady_walk(wall_, 0.7, 60, 540);
  const auto sampled = sample_query(query, route_);
  Matrices matrices(route_);
  const auto found = place::match_on_route(route_, query.walk.time_s, sampled, options_, std::ref(matrices));
  EXPECT_THAT(matrices.cost, SizeIs(3));
  std::vector<place::RouteMatches> each;
  for (const auto& traverse : route_.traverses) {
    place::Route only = route_;
    only.traverses = {traverse};
    each.push_back(place::match_on_route(only, query.walk.time_s, sampled, options_));
  }
  for (std::size_t q = 0; q < found.matches.size(); ++q) {
    const place::Match* surest = nullptr;
    for (const auto& one : each) {
      const auto& match = one.matches[q];
      const auto sureness = [](const place::Match& m) {
        return std::pair(m.probability.value_or(0), m.score);
      };
      if (match.place && (surest == nullptr || sureness(match) > sureness(*surest))) surest = &match;
    }
    ASSERT_TRUE(surest != nullptr && found.matches[q].place);
    EXPECT_EQ(found.matches[q].place->traverse, surest->place->traverse);
    EXPECT_EQ(found.matches[q].place->keyframe, surest->place->keyframe);
    EXPECT_EQ(found.matches[q].score, surest->score);
    EXPECT_EQ(found.matches[q].partial, surest->partial);
  }
  EXPECT_EQ(share_found(found, query, 1.0 * spacing_px(route_.traverses[0])), 1);
}

TEST_F(RouteMatchingTest, AcceptsByProbability) {
  options_.accept_score.reset();
  const auto query = steady_walk(wall_, 0.7, 60, 540);
  for (const place::SearchMethod& method : place::search_methods()) {
    options_.method = method.name;
    const auto found =
        place::match_on_route(route_, query.walk.time_s, sample_query(query, route_), options_);
    EXPECT_EQ(found.probability_source, place::ProbabilitySource::kDecoys) << method.name;
    EXPECT_EQ(found.lines > 0, method.name == "lines");
    std::size_t accepted = 0;
    for (const place::Match& match : found.matches) {
      if (!match.place) continue;
      ASSERT_TRUE(match.probability && match.sd_keyframes && match.sd_m) << method.name;
      EXPECT_EQ(match.accepted, *match.probability >= 0.95) << method.name;
      // Between its neighbours, where it has two.
      const auto& keyframes = route_.traverses[0].keyframes;
      const std::size_t before = match.place->keyframe - (match.place->keyframe > 0 ? 1 : 0);
      const std::size_t after = std::min(keyframes.size() - 1, match.place->keyframe + 1);
      EXPECT_NEAR(*match.sd_m,
                  *match.sd_keyframes * (*keyframes[after].distance_m - *keyframes[before].distance_m) /
                      static_cast<double>(after - before),
                  1e-9);
      accepted += match.accepted ? 1 : 0;
    }
    EXPECT_GE(accepted, found.matches.size() * 8 / 10) << method.name;
  }
}

TEST_F(RouteMatchingTest, APathFindsTheWalkFromEndToEnd) {
  options_.method = "path";
  const auto query = steady_walk(wall_, 0.7, 60, 540);
  const auto found = place::match_on_route(route_, query.walk.time_s, sample_query(query, route_), options_);
  EXPECT_EQ(share_found(found, query, 1.5 * spacing_px(route_.traverses[0])), 1);
}

TEST_F(RouteMatchingTest, ASearchGoesByTheWalksOwnSteps) {
  const auto query = steady_walk(wall_, 0.7, 60, 540);
  const place::SampledWalk sampled = sample_query(query, route_);
  const place::Traverse& traverse = route_.traverses[0];
  const place::SearchOptions search = place::search_on_route(traverse, query.walk.time_s, sampled, options_);
  EXPECT_EQ(search.sequence.length, 10);
  EXPECT_THAT(search.gaps.query, testing::IsEmpty());
  ASSERT_THAT(search.path.steps, SizeIs(sampled.frames.size()));
  EXPECT_EQ(search.path.steps.front(), 0);  // it says nothing
  // Together they are the way between the first and the last keyframe, in keyframes of the traverse.
  double steps = 0, way = 0;
  for (const double step : search.path.steps) steps += step;
  for (std::size_t f = sampled.frames.front() + 1; f <= sampled.frames.back(); ++f)
    way += sampled.displacement[f];
  const double there = traverse.keyframes.back().displacement - traverse.keyframes.front().displacement;
  EXPECT_NEAR(steps, way / there * static_cast<double>(traverse.keyframes.size() - 1), 1e-9);
  // Both are sampled to one unit, and a keyframe is a frame: 0.7 px of some 5 px.
  for (std::size_t q = 1; q < search.path.steps.size(); ++q) EXPECT_NEAR(search.path.steps[q], 1, 0.25) << q;
}

TEST_F(RouteMatchingTest, ASearchOfAWalkWithoutMotionHasNoSteps) {
  const auto query = steady_walk(wall_, 0.7, 60, 540);
  place::SampledWalk sampled = sample_query(query, route_);
  sampled.displacement.clear();
  EXPECT_THAT(place::search_on_route(route_.traverses[0], query.walk.time_s, sampled, options_).path.steps,
              testing::IsEmpty());
}

TEST_F(RouteMatchingTest, NoSequenceCrossesAJumpOfTheClock) {
  auto query = steady_walk(wall_, 0.7, 60, 540);
  const place::SampledWalk sampled = sample_query(query, route_);
  const std::size_t after = sampled.frames[sampled.frames.size() / 2];
  for (std::size_t f = after; f < query.walk.time_s.size(); ++f) query.walk.time_s[f] += 10;
  EXPECT_THAT(place::search_on_route(route_.traverses[0], query.walk.time_s, sampled, options_).gaps.query,
              testing::ElementsAre(sampled.frames.size() / 2));
  // Lines on either side are cut as at the walk's ends.
  const auto found = place::match_on_route(route_, query.walk.time_s, sampled, options_);
  EXPECT_TRUE(found.matches[sampled.frames.size() / 2].partial);
  EXPECT_FALSE(found.matches[sampled.frames.size() / 2 + 10].partial);
}

TEST_F(RouteMatchingTest, NoSequenceCrossesAGapOfTheReference) {
  // The reference: the wall's first half, the camera put away for ten minutes, and some of it once more.
  const std::vector<double> once_px = places(0, std::vector<double>(600, 0.5));
  const std::size_t jump = once_px.size();
  std::vector<double> twice_px = once_px;
  twice_px.insert(twice_px.end(), once_px.begin() + 120, once_px.begin() + 520);
  auto twice = known_walk(wall_, twice_px);
  for (std::size_t f = jump; f < twice.walk.frames(); ++f) twice.walk.time_s[f] += 600;
  twice.walk.gaps = vo::clock_gaps(twice.walk.time_s);
  place::Route route;
  add_traverse(route, "twice", twice);
  const std::vector<std::size_t> gaps = place::gaps_of(route.traverses[0]);
  ASSERT_THAT(gaps, SizeIs(1));
  EXPECT_EQ(route.traverses[0].keyframes[gaps[0]].frame, static_cast<std::int64_t>(jump));

  // The query: the same course, but without a pause, so that a line of it fits one across the gap exactly.
  std::vector<double> on_px = places(200, std::vector<double>(200, 0.5));
  const std::size_t seam = on_px.size();
  on_px.insert(on_px.end(), once_px.begin() + 120, once_px.begin() + 320);
  const auto query = known_walk(wall_, on_px);
  const place::SampledWalk sampled = sample_query(query, route);
  EXPECT_EQ(place::search_on_route(route.traverses[0], query.walk.time_s, sampled, options_).gaps.reference,
            gaps);
  const auto at_seam =
      static_cast<std::size_t>(std::ranges::lower_bound(sampled.frames, seam) - sampled.frames.begin());
  for (const place::CandidateUse use : {place::CandidateUse::kNever, place::CandidateUse::kAlways}) {
    options_.candidate_use = use;
    const auto found = place::match_on_route(route, query.walk.time_s, sampled, options_);
    // Whatever is found about the seam ends at the gap, as at an end of the walk.
    for (const std::size_t q : {at_seam - 1, at_seam}) {
      ASSERT_TRUE(found.matches[q].place);
      if (static_cast<std::size_t>(std::abs(static_cast<int>(found.matches[q].place->keyframe) -
                                            static_cast<int>(gaps[0]))) <= 1) {
        EXPECT_TRUE(found.matches[q].partial);
      }
    }
    place::Route without_gap = route;
    for (place::Keyframe& keyframe : without_gap.traverses[0].keyframes) keyframe.after_gap = false;
    const auto across = place::match_on_route(without_gap, query.walk.time_s, sampled, options_);
    EXPECT_EQ(across.matches[at_seam].place->keyframe, gaps[0]);
    EXPECT_FALSE(across.matches[at_seam].partial);
  }
}

TEST_F(RouteMatchingTest, TraversesThatShareNoPlaceAreSearchedApart) {
  add_traverse(route_, "elsewhere", steady_walk(Wall(kWallPx, 99), 0.5));
  const auto query = steady_walk(wall_, 0.7, 60, 540);
  const auto sampled = sample_query(query, route_);
  const auto joined = place::match_on_route(route_, query.walk.time_s, sampled, options_);
  ASSERT_THAT(joined.warnings, SizeIs(1));
  EXPECT_THAT(joined.warnings[0], testing::HasSubstr("'by day' and 'elsewhere' share no place"));
  options_.fuse_traverses = false;
  const auto apart = place::match_on_route(route_, query.walk.time_s, sampled, options_);
  EXPECT_TRUE(apart.warnings.empty());
  for (std::size_t q = 0; q < joined.matches.size(); ++q)
    EXPECT_EQ(joined.matches[q].score, apart.matches[q].score);
}

TEST_F(RouteMatchingTest, TraversesOfOneRouteBearEachOtherOut) {
  add_traverse(route_, "again", steady_walk(wall_, 0.4));
  const auto query = steady_walk(wall_, 0.7, 60, 540);
  const auto found = place::match_on_route(route_, query.walk.time_s, sample_query(query, route_), options_);
  EXPECT_TRUE(found.warnings.empty());
  EXPECT_EQ(share_found(found, query, 1.0 * spacing_px(route_.traverses[0])), 1);
}

TEST_F(RouteMatchingTest, AcceptsLittleOfAWalkThatWasNeverOnTheRoute) {
  const Wall another(kWallPx, 77);
  const auto here = steady_walk(wall_, 0.5, 100, 400), elsewhere = steady_walk(another, 0.5, 100, 400);
  const auto mean_score = [&](const KnownWalk& query) {
    const auto found =
        place::match_on_route(route_, query.walk.time_s, sample_query(query, route_), options_);
    double sum = 0;
    for (const auto& match : found.matches) sum += match.score;
    return sum / static_cast<double>(found.matches.size());
  };
  EXPECT_GT(mean_score(here), 2 * mean_score(elsewhere));
}

TEST_F(RouteMatchingTest, RefusesAReferenceShorterThanTheSequence) {
  const auto query = steady_walk(wall_, 0.5, 100, 300);
  const auto sampled = sample_query(query, route_);
  const std::size_t keyframes = route_.traverses[0].keyframes.size();
  options_.search.length = static_cast<int>(keyframes);
  EXPECT_NO_THROW(place::match_on_route(route_, query.walk.time_s, sampled, options_));
  options_.search.length = static_cast<int>(keyframes) + 1;
  EXPECT_THROW_WITH(place::match_on_route(route_, query.walk.time_s, sampled, options_), vo::Error,
                    "traverse 'by day': has " + std::to_string(keyframes) + " keyframes, the sequence " +
                        std::to_string(keyframes + 1));
  route_.traverses.clear();
  EXPECT_THROW(place::match_on_route(route_, query.walk.time_s, sampled, options_), std::invalid_argument);
}

TEST_F(RouteMatchingTest, AQueryShorterThanHalfASequenceIsNotFound) {
  const auto query = steady_walk(wall_, 0.5, 100, 300);
  auto sampled = sample_query(query, route_);
  sampled.frames.resize(4);
  sampled.thumbnails = vo::select(query.walk.thumbnails, sampled.frames);
  sampled.descriptors = {sampled.thumbnails};
  const auto found = place::match_on_route(route_, query.walk.time_s, sampled, options_);
  ASSERT_THAT(found.matches, SizeIs(4));
  for (const auto& match : found.matches) {
    EXPECT_FALSE(match.place);
    EXPECT_FALSE(match.accepted);
    EXPECT_EQ(match.score, 0);
  }
}

TEST_F(RouteMatchingTest, TakesTheSequenceLengthInMetres) {
  const auto query = steady_walk(wall_, 0.5, 100, 300);
  const auto sampled = sample_query(query, route_);
  const double spacing_m = spacing_px(route_.traverses[0]) / 10;
  options_.sequence_length_m = 14.4 * spacing_m;
  EXPECT_EQ(place::match_on_route(route_, query.walk.time_s, sampled, options_).sequence_length, 14);
  options_.sequence_length_m = 0.1 * spacing_m;
  EXPECT_EQ(place::match_on_route(route_, query.walk.time_s, sampled, options_).sequence_length, 1);
  add_traverse(route_, "not surveyed", steady_walk(wall_, 0.5), {}, false);
  EXPECT_THROW_WITH(place::match_on_route(route_, query.walk.time_s, sampled, options_), vo::Error,
                    "traverse 'not surveyed': has no surveyed distances");
}

TEST_F(RouteMatchingTest, TheOriginalsSearchLeavesTheEndsUnmatched) {
  const auto query = steady_walk(wall_, 0.5, 100, 400);
  options_.openseqslam = place::openseqslam::Options{};
  options_.openseqslam->quirks = place::openseqslam::Quirks::original();
  const auto found = place::match_on_route(route_, query.walk.time_s, sample_query(query, route_), options_);
  EXPECT_EQ(found.sequence_length, 10);
  EXPECT_EQ(found.lines, 0);
  const std::size_t count = found.matches.size();
  for (std::size_t q = 0; q < count; ++q) {
    const auto& match = found.matches[q];
    EXPECT_EQ(match.place.has_value(), q >= 5 && q + 5 < count) << q;
    EXPECT_FALSE(match.partial);
    // 1 - best / second: a surer match scores higher, as everywhere.
    EXPECT_GE(match.score, 0);
    EXPECT_LE(match.score, 1);
  }
  // But for the 10 at the ends; the original's place is off by up to two keyframes more.
  EXPECT_EQ(share_found(found, query, 3 * spacing_px(route_.traverses[0])),
            1 - 10.0 / static_cast<double>(count));
}

TEST_F(RouteMatchingTest, IsTheSameForAnyThreadCount) {
  const auto query = steady_walk(wall_, 0.8, 100, 400);
  const auto run = [&](int threads) {
    vo::set_thread_count(threads);
    return place::match_on_route(route_, query.walk.time_s, sample_query(query, route_), options_);
  };
  const auto one = run(1), four = run(4);
  vo::set_thread_count(0);
  ASSERT_EQ(one.matches.size(), four.matches.size());
  for (std::size_t q = 0; q < one.matches.size(); ++q) {
    EXPECT_EQ(one.matches[q].query_frame, four.matches[q].query_frame);
    EXPECT_EQ(one.matches[q].place->keyframe, four.matches[q].place->keyframe);
    EXPECT_EQ(one.matches[q].score, four.matches[q].score);
  }
}

}  // namespace
