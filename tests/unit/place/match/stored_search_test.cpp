#include "place/match/stored_search.hpp"

#include "support/random_columns.hpp"
#include "support/random_images.hpp"
#include "support/temporary_folder.hpp"
#include "support/thread_team.hpp"

#include <map>
#include <mutex>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <place/match/match_io.hpp>
#include <place/resolve.hpp>
#include <place/route/route_database.hpp>
#include <place/route/stored_descriptors.hpp>
#include <place/stage_options.hpp>
#include <vo/base/error.hpp>

namespace {

using place::Descriptors;
using place::Settings;
using test_support::TemporaryFolder;
using test_support::ThreadTeam;

constexpr std::size_t kKeyframes = 5 * place::kShardBlock + 77, kQueries = 60, kStart = 1000;

/// A route of random keyframes in a database, and a walk along a part of it that crosses shards' borders.
class StoredSearchTest : public testing::Test {
 protected:
  void make(const std::string& descriptor, std::size_t traverses = 1) {
    Settings given;
    given.motion = "none";
    given.every = 1;
    given.descriptor = descriptor;
    settings_ = given;
    path_ = folder_ / "route.db";
    const bool thumbnails = descriptor.find("thumbnail") != std::string::npos;
    for (std::size_t t = 0; t < traverses; ++t) {
      place::Traverse& traverse = route_.traverses.emplace_back();
      traverse.name = std::string(1, static_cast<char>('a' + t));
      for (std::size_t i = 0; i < kKeyframes; ++i) {
        place::Keyframe keyframe;
        keyframe.frame = static_cast<std::int64_t>(i);
        keyframe.time_s = static_cast<double>(i);
        keyframe.after_gap = i == 1030;
        traverse.keyframes.push_back(keyframe);
      }
      traverse.descriptors.emplace_back(test_support::random_columns(8, 16, kKeyframes, 60, 1 + t));
      if (thumbnails)
        traverse.descriptors.emplace_back(test_support::random_images(64, 32, kKeyframes, 9 + t));
    }
    route_.learned.resize(route_.traverses.front().descriptors.size());
    place::write_route(path_, route_);
    std::vector<std::size_t> walked;
    for (std::size_t q = 0; q < kQueries; ++q) walked.push_back(kStart + q);
    for (const Descriptors& kind : route_.traverses.front().descriptors)
      sampled_.descriptors.push_back(place::select(kind, walked));
    // Half of each view is replaced, so that costs are not 0.
    auto& columns = std::get<place::ColumnStack>(sampled_.descriptors.front());
    const auto noise = test_support::random_columns(8, 16, kQueries, 60, 77);
    for (std::size_t i = 0; i < columns.values.size(); i += 2) columns.values[i] = noise.values[i];
    for (std::size_t q = 0; q < kQueries; ++q) {
      sampled_.frames.push_back(q);
      time_s_.push_back(static_cast<double>(q));
    }
  }

  [[nodiscard]] Settings resolved() const { return place::resolve(settings_, {}); }
  [[nodiscard]] place::RouteMatchingOptions options() const {
    return place::stage_options(resolved()).matching;
  }

  std::string in_memory() const {
    return place::to_csv(place::match_on_route(route_, time_s_, sampled_, options()).matches);
  }

  /// The matches that the first member of a team writes; also the bytes of descriptors that each read.
  std::string by_team(std::size_t members, std::map<std::size_t, std::uint64_t>* read = nullptr) const {
    std::string csv;
    std::mutex mutex;
    ThreadTeam::run(members, [&](place::Team& team) {
      std::uint64_t bytes = 0;
      if (team.rank() > 0) {
        bytes = place::serve_shards(path_, team);
      } else {
        place::Route light = place::read_route(path_, {.descriptors = false});
        place::StoredSearch search(path_, team);
        search.prepare(resolved(), light);
        place::RouteMatchingOptions with_search = options();
        with_search.traverse_search = &search;
        csv = place::to_csv(place::match_on_route(light, time_s_, sampled_, with_search).matches);
        search.finish();
        bytes = search.bytes_read();
      }
      const std::scoped_lock lock(mutex);
      if (read != nullptr) (*read)[team.rank()] = bytes;
    });
    return csv;
  }

  void expect_the_same_for_any_team() {
    const std::string expected = in_memory();
    for (const std::size_t members : {1U, 2U, 3U, 5U, 8U})
      EXPECT_EQ(by_team(members), expected) << members << " members";
  }

  TemporaryFolder folder_;
  std::filesystem::path path_;
  place::Route route_;
  place::SampledWalk sampled_;
  std::vector<double> time_s_;
  Settings settings_;
};

TEST_F(StoredSearchTest, FindsWhatASearchInMemoryFindsByDefault) {
  make("blocks");
  expect_the_same_for_any_team();
  // And that is the walk.
  const auto found = place::match_on_route(route_, time_s_, sampled_, options()).matches;
  for (std::size_t q = 0; q < kQueries; ++q) EXPECT_EQ(found[q].place->keyframe, kStart + q);
}

TEST_F(StoredSearchTest, FindsItByLinesAndLocalContrast) {
  make("blocks");
  settings_.search = "lines";
  expect_the_same_for_any_team();
  settings_.enhance = "local";
  expect_the_same_for_any_team();
}

TEST_F(StoredSearchTest, FindsItBySeveralDescriptors) {
  make("blocks+thumbnail");
  expect_the_same_for_any_team();
}

TEST_F(StoredSearchTest, FindsItOnAShortlist) {
  make("blocks+thumbnail");
  settings_.candidates = "always";
  expect_the_same_for_any_team();
}

TEST_F(StoredSearchTest, FindsItOnTheBetterOfTwoTraverses) {
  make("blocks", 2);
  settings_.fuse_traverses = false;
  expect_the_same_for_any_team();
}

TEST_F(StoredSearchTest, GivesTheCostsOfAllKeyframesForTheScale) {
  make("blocks");
  const place::CostMatrix whole = place::cost_matrix_on_route(sampled_, route_.traverses[0], options());
  for (const std::size_t members : {1U, 3U, 8U}) {
    ThreadTeam::run(members, [&](place::Team& team) {
      if (team.rank() > 0) {
        place::serve_shards(path_, team);
        return;
      }
      place::StoredSearch search(path_, team);
      search.prepare(resolved(), route_);
      EXPECT_EQ(search.scale_costs(0, sampled_.descriptors.front()).values, whole.values);
      search.finish();
    });
  }
}

TEST_F(StoredSearchTest, MembersReadTheirOwnPartOfTheFileOnly) {
  make("blocks");
  std::map<std::size_t, std::uint64_t> read;
  by_team(5, &read);
  const std::uint64_t each = place::StoredDescriptors(path_, 0).bytes_of_each(0);
  // A shard is one block or two; beside it are a block of the file on either side, less than 256 keyframes.
  const auto shards = place::shards_of(kKeyframes, 5);
  for (const auto& [rank, bytes] : read) {
    EXPECT_GE(bytes, shards[rank].size() * each);
    EXPECT_LE(bytes, (shards[rank].size() + 512) * each);
  }
}

TEST_F(StoredSearchTest, RefusesWhatPartsCannotDo) {
  make("blocks", 2);
  const auto refused = [&](std::size_t members, const char* says) {
    ThreadTeam::run(members, [&](place::Team& team) {
      if (team.rank() > 0) return;
      place::StoredSearch search(path_, team);
      EXPECT_THROW_WITH(search.prepare(resolved(), route_), vo::Error, says);
    });
  };
  refused(2, "fuse-traverses: cannot be divided among processes, with 2 traverses");
  refused(1, "fuse-traverses: needs the route in memory");
  settings_.fuse_traverses = false;
  settings_.search = "graph";
  refused(2, "search graph: cannot be divided among processes; expected path or lines");
  settings_.search.reset();
  settings_.enhance = "none";
  refused(2, "enhance none");
}

TEST_F(StoredSearchTest, SaysWhenTheCostsDoNotFitTheMemory) {
  make("blocks");
  place::Alone alone;
  place::StoredSearch search(path_, alone, std::size_t{200} << 20U);
  search.prepare(resolved(), route_);
  place::RouteMatchingOptions with_search = options();
  with_search.traverse_search = &search;
  EXPECT_THROW_WITH(place::match_on_route(route_, time_s_, sampled_, with_search), vo::Error,
                    "--memory 200M: is too little");
}

TEST_F(StoredSearchTest, RefusesAFileThatIsNoLongerTheRouteThatWasRead) {
  make("blocks");
  const place::Route light = place::read_route(path_, {.descriptors = false});
  place::Route other = route_;
  other.traverses.front().name = "another";
  place::write_route(path_, other);
  place::Alone alone;
  place::StoredSearch search(path_, alone);
  search.prepare(resolved(), light);
  place::RouteMatchingOptions with_search = options();
  with_search.traverse_search = &search;
  EXPECT_THROW_WITH(place::match_on_route(light, time_s_, sampled_, with_search), vo::Error,
                    "has changed since it was read");
}

TEST_F(StoredSearchTest, RefusesShiftedThumbnails) {
  make("blocks+thumbnail");
  settings_.max_shift_px = 4;
  place::Alone alone;
  place::StoredSearch search(path_, alone);
  EXPECT_THROW_WITH(search.prepare(resolved(), route_), vo::Error, "max-shift-px of thumbnails");
  search.finish();
}

}  // namespace
