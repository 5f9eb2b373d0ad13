#include "route/sqlite.hpp"
#include "support/example_route.hpp"
#include "support/random_images.hpp"
#include "support/temporary_folder.hpp"

#include <bit>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <stdexcept>
#include <string>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <place/describe/quantise.hpp>
#include <place/route/route_database.hpp>
#include <place/version.hpp>
#include <vo/base/error.hpp>
#include <vo/io/atomic_file.hpp>

namespace {

namespace fs = std::filesystem;
using test_support::example_route;
using test_support::example_traverse;
using test_support::expect_equal;
using test_support::random_images;
using test_support::read_file;
using test_support::TemporaryFolder;

std::size_t files_in(const TemporaryFolder& folder) {
  return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder.path()), {}));
}

/// A route without its digests, which would find every change first.
place::sqlite::Database changed_by_hand(const fs::path& route) {
  place::sqlite::Database database(route, place::sqlite::Database::Mode::kCreate, "r.db");
  database.run("DROP TABLE row_digest");
  return database;
}

/// What reading says of a route that was changed by hand; empty if nothing.
std::string said_of(const fs::path& file, const place::Route& route, const std::string& sql) {
  place::write_route(file, route);
  changed_by_hand(file).run(sql);
  try {
    static_cast<void>(place::read_route(file));
  } catch (const vo::Error& error) {
    return error.what();
  }
  return {};
}

/// A route of so many keyframes.
place::Route small_route(std::size_t keyframes) {
  place::Route route = example_route();
  route.traverses.resize(1);
  route.traverses[0] = example_traverse("a", keyframes, 1);
  return route;
}

TEST(RouteDatabase, RoundTripsEverything) {
  const TemporaryFolder folder;
  const place::Route route = example_route();
  place::write_route(folder / "r.db", route);
  const place::Route back = place::read_route(folder / "r.db");
  expect_equal(back, route);
  EXPECT_EQ(back.software_version, place::kVersion);
  EXPECT_EQ(files_in(folder), 1U);  // no journal, no temporary
}

TEST(RouteDatabase, RoundTripsTheOtherKinds) {
  const TemporaryFolder folder;
  place::Route route;  // defaults: grid patches, motion by alignment error; no traverse
  place::write_route(folder / "r.db", route);
  expect_equal(place::read_route(folder / "r.db"), route);
}

TEST(RouteDatabase, LeavesPreviewsOutWhereTheyAreNotWanted) {
  const TemporaryFolder folder;
  place::Route route = example_route();
  place::write_route(folder / "r.db", route);
  for (auto& traverse : route.traverses) {
    for (auto& keyframe : traverse.keyframes) keyframe.preview_jpeg.clear();
    traverse.thumbnails = {};
  }
  expect_equal(place::read_route(folder / "r.db", {.previews = false}), route);
}

TEST(RouteDatabase, KeepsPointsWhereThereAreAny) {
  const TemporaryFolder folder;
  place::Route route = example_route();
  place::write_route(folder / "r.db", route);
  const auto without = fs::file_size(folder / "r.db");
  EXPECT_FALSE(place::has_view_points(place::read_route(folder / "r.db")));  // nor a table for them
  for (std::size_t i = 0; i < 256; ++i)  // of the second traverse only, now and then none
    route.traverses[1].view_points.emplace_back(37 * (i % 3), static_cast<std::uint8_t>(i));
  place::write_route(folder / "r.db", route);
  const place::Route back = place::read_route(folder / "r.db");
  EXPECT_TRUE(place::has_view_points(back));
  for (std::size_t i = 0; i < route.traverses.size(); ++i)
    EXPECT_EQ(back.traverses[i].view_points, route.traverses[i].view_points) << i;
  EXPECT_FALSE(place::has_view_points(place::read_route(folder / "r.db", {.view_points = false})));
  EXPECT_GE(fs::file_size(folder / "r.db"), without + 256 * 37);

  const auto damage = [&](const char* sql) {
    place::write_route(folder / "r.db", route);
    changed_by_hand(folder / "r.db").run(sql);
  };
  damage("UPDATE view_points SET bytes = x'00' WHERE position = 1");
  EXPECT_THROW_WITH(place::read_route(folder / "r.db"), vo::Error,
                    "r.db: is damaged: the points of a keyframe do not fit their checksum");
  damage("DELETE FROM view_points WHERE position = 1");
  EXPECT_THROW_WITH(place::read_route(folder / "r.db"), vo::Error,
                    "r.db: is damaged: points of keyframes are missing");
  route.traverses[1].view_points.pop_back();
  EXPECT_THROW(place::write_route(folder / "r.db", route), std::invalid_argument);
}

TEST(RouteDatabase, KeepsNamedPlaces) {
  const TemporaryFolder folder;
  place::Route route = example_route();
  place::write_route(folder / "r.db", route);
  const place::Route back = place::read_route(folder / "r.db", {.previews = false, .view_points = false});
  EXPECT_TRUE(back.traverses[0].places.empty());
  ASSERT_EQ(back.traverses[1].places.size(), 2U);
  EXPECT_EQ(back.traverses[1].places[0].name, "gate");
  EXPECT_EQ(back.traverses[1].places[0].frame, 3);
  EXPECT_FALSE(back.traverses[1].places[0].distance_m);
  EXPECT_EQ(back.traverses[1].places[1].name, "caf\xC3\xA9 \"<b>\"");
  EXPECT_EQ(back.traverses[1].places[1].distance_m, 12.25);
  EXPECT_TRUE(place::has_named_places(back));
  route.traverses[1].places.clear();
  place::write_route(folder / "r.db", route);
  EXPECT_FALSE(place::has_named_places(place::read_route(folder / "r.db")));
}

TEST(RouteDatabase, EqualRoutesGiveEqualBytes) {
  const TemporaryFolder folder;
  place::write_route(folder / "a.db", example_route());
  place::write_route(folder / "b.db", example_route());
  EXPECT_EQ(read_file(folder / "a.db"), read_file(folder / "b.db"));
  // Also after reading and writing back, over what is there.
  place::write_route(folder / "b.db", place::read_route(folder / "a.db"));
  EXPECT_EQ(read_file(folder / "a.db"), read_file(folder / "b.db"));
  place::Route other = example_route();
  other.traverses[0].thumbnails.pixels[0] ^= 1;
  place::write_route(folder / "b.db", other);
  EXPECT_NE(read_file(folder / "a.db"), read_file(folder / "b.db"));
}

TEST(RouteDatabase, TakesAnotherTraverse) {
  const TemporaryFolder folder;
  place::write_route(folder / "r.db", example_route());
  place::Route route = place::read_route(folder / "r.db");
  route.traverses.push_back(example_traverse("in rain", 30, 9));
  place::write_route(folder / "r.db", route);
  place::Route expected = example_route();
  expected.traverses.push_back(example_traverse("in rain", 30, 9));
  expect_equal(place::read_route(folder / "r.db"), expected);
}

TEST(RouteDatabase, SaysWhatIsNoRouteDatabase) {
  const TemporaryFolder folder;
  EXPECT_THROW_WITH(place::read_route(folder / "none.db"), vo::Error, "none.db: does not exist");
  EXPECT_THROW_WITH(place::read_route(folder.path()), vo::Error, "is no file");
  EXPECT_THROW_WITH(place::read_route(folder.write("text.db", std::string(5000, 'x'))), vo::Error,
                    "text.db: is no route database");
  EXPECT_THROW_WITH(place::read_route(folder.write("empty.db", "")), vo::Error,
                    "empty.db: is no route database");
}

TEST(RouteDatabase, RefusesAnotherProgramsDatabaseAndAnotherSchema) {
  const TemporaryFolder folder;
  place::write_route(folder / "r.db", example_route());
  const std::string bytes = read_file(folder / "r.db");
  // SQLite's file header: user version at bytes 60-63, application id at 68-71, most significant byte first.
  for (const int version : {place::kRouteSchemaVersion - 1, place::kRouteSchemaVersion + 1}) {
    std::string another = bytes;
    another[63] = static_cast<char>(version);
    EXPECT_THROW_WITH(place::read_route(folder.write("another.db", another)), vo::Error,
                      "another.db: has schema version " + std::to_string(version) +
                          ", written by another version of retrace; expected schema version " +
                          std::to_string(place::kRouteSchemaVersion) + "; build the route again");
  }
  std::string other = bytes;
  other[71] = static_cast<char>(other[71] + 1);
  EXPECT_THROW_WITH(place::read_route(folder.write("other.db", other)), vo::Error,
                    "other.db: is no route database");
}

TEST(RouteDatabase, RefusesSettingsThatThereAreNot) {
  const TemporaryFolder folder;
  place::write_route(folder / "r.db", example_route());
  const place::sqlite::Database database = changed_by_hand(folder / "r.db");
  database.run("INSERT INTO route_setting VALUES('sampling-m', '3')");
  EXPECT_THROW_WITH(place::read_route(folder / "r.db"), vo::Error,
                    "r.db: is damaged: its settings: sampling-m: is no setting");
  database.run("UPDATE route_setting SET name = 'sampling-n', value = 'x' WHERE name = 'sampling-m'");
  EXPECT_THROW_WITH(place::read_route(folder / "r.db"), vo::Error, "sampling-n: is 'x'; expected a number");
}

TEST(RouteDatabase, FindsTruncation) {
  const TemporaryFolder folder;
  place::write_route(folder / "r.db", example_route());
  const std::string bytes = read_file(folder / "r.db");
  // Within the header, within a page, at a page's end, before the last byte.
  constexpr std::size_t kPage = 16384;
  for (const std::size_t length : {std::size_t{50}, std::size_t{3000}, kPage, bytes.size() / 2,
                                   bytes.size() / 2 / kPage * kPage, bytes.size() - 1}) {
    SCOPED_TRACE(length);
    const auto path = folder.write("t.db", bytes.substr(0, length));
    EXPECT_THROW_WITH(place::read_route(path), vo::Error, "t.db: is ");
  }
}

TEST(RouteDatabase, FindsAFlippedBitOfAThumbnail) {
  const TemporaryFolder folder;
  place::Route route = example_route();
  // A chunk of known content, so that it is found in the file.
  for (auto& pixel : route.traverses[1].thumbnails.pixels) pixel = 0xA5;
  place::write_route(folder / "r.db", route);
  std::string bytes = read_file(folder / "r.db");
  const std::size_t found = bytes.find(std::string(64, '\xA5'));
  ASSERT_NE(found, std::string::npos);
  bytes[found + 13] ^= 1;
  EXPECT_THROW_WITH(place::read_route(folder.write("r.db", bytes)), vo::Error,
                    "r.db: is damaged: a block of thumbnails does not fit its checksum");
}

TEST(RouteDatabase, FindsAFlippedBitOfADescriptor) {
  const TemporaryFolder folder;
  place::Route route = example_route();
  for (auto& value : std::get<place::ColumnStack>(route.traverses[1].descriptors[0]).values) value = 0x5A;
  place::write_route(folder / "r.db", route);
  std::string bytes = read_file(folder / "r.db");
  const std::size_t found = bytes.find(std::string(64, '\x5A'));
  ASSERT_NE(found, std::string::npos);
  bytes[found + 13] ^= 1;
  EXPECT_THROW_WITH(place::read_route(folder.write("r.db", bytes)), vo::Error,
                    "r.db: is damaged: a block of descriptors does not fit its checksum");
}

TEST(RouteDatabase, FindsThumbnailsWithoutAKeyframeAndCountsThatAreNotTrue) {
  const TemporaryFolder folder;
  const auto damaged_by = [&](const char* sql) { return said_of(folder / "r.db", example_route(), sql); };
  EXPECT_THAT(damaged_by("DELETE FROM keyframe WHERE traverse = 1 AND position = 0;"
                         "UPDATE traverse SET keyframes = keyframes - 1 WHERE id = 1"),
              testing::HasSubstr("r.db: is damaged: there are more thumbnails than keyframes"));
  EXPECT_THAT(damaged_by("DELETE FROM thumbnail_chunk WHERE traverse = 1"),
              testing::HasSubstr("thumbnails are missing"));
  EXPECT_THAT(damaged_by("UPDATE traverse SET keyframes = 1152921504606846976 WHERE id = 1"),
              testing::HasSubstr("keyframes are missing"));
}

TEST(RouteDatabase, HoldsAFileMadeToDeceiveToItsSize) {
  const TemporaryFolder folder;
  const auto damaged_by = [&](const std::string& sql) {
    place::Route route;
    route.traverses.push_back(example_traverse("day", 4, 1));
    route.learned.resize(3);
    const std::string said = said_of(folder / "r.db", route, sql);
    EXPECT_THAT(said, testing::HasSubstr("r.db: is damaged")) << sql;
    return said;
  };
  // Rows without end, and a value of 100 MB, of which the file has only how they are made.
  damaged_by(
      "ALTER TABLE keyframe RENAME TO old; CREATE VIEW keyframe AS WITH RECURSIVE n(i) AS (SELECT 0 "
      "UNION ALL SELECT i + 1 FROM n) SELECT 1 AS traverse, i AS position, i AS frame, i AS time_s, "
      "0 AS displacement, NULL AS distance_m, NULL AS x_m, NULL AS y_m, NULL AS heading_rad, "
      "0 AS after_gap FROM n");
  damaged_by(
      "DROP TABLE learned; CREATE TABLE learned(descriptor INTEGER PRIMARY KEY, checksum AS (0), "
      "bytes AS (zeroblob(100000000))); INSERT INTO learned(descriptor) VALUES(0), (1), (2)");
  // Memory for what a size and a count say is not taken before it is known to be there.
  EXPECT_THAT(damaged_by("UPDATE traverse SET thumbnail_width = 1024, thumbnail_height = 1024"),
              testing::HasSubstr("thumbnails are missing"));
  EXPECT_THAT(damaged_by("UPDATE descriptor SET width = 4096, height = 4096 WHERE form = 'pixels'"),
              testing::HasSubstr("descriptors are missing"));
}

TEST(RouteDatabase, RefusesKeyframesAndPlacesThatCannotBe) {
  const TemporaryFolder folder;
  const auto damaged_by = [&](const std::string& sql, const std::string& what) {
    place::write_route(folder / "r.db", example_route());
    changed_by_hand(folder / "r.db").run(sql);
    EXPECT_THROW_WITH(place::read_route(folder / "r.db"), vo::Error, "r.db: is damaged: " + what);
  };
  damaged_by("UPDATE keyframe SET frame = 7 WHERE traverse = 1 AND position = 2",
             "keyframes are not in order");
  damaged_by("UPDATE keyframe SET frame = -1 WHERE traverse = 1 AND position = 0",
             "keyframes are not in order");
  damaged_by("UPDATE keyframe SET time_s = 0.1 WHERE traverse = 1 AND position = 2",
             "keyframes are not in order");
  damaged_by("UPDATE keyframe SET after_gap = 1 WHERE traverse = 1 AND position = 0",
             "keyframes are not in order");
  damaged_by("UPDATE keyframe SET displacement = 9e999 WHERE traverse = 1 AND position = 3",
             "a value of a keyframe is no number");
  damaged_by("UPDATE keyframe SET y_m = -9e999 WHERE traverse = 1 AND position = 3",
             "a value of a keyframe is no number");
  damaged_by("UPDATE named_place SET frame = -3 WHERE name = 'gate'", "a named place is none");
  damaged_by("UPDATE named_place SET name = '' WHERE name = 'gate'", "a named place is none");
  damaged_by("UPDATE traverse SET frame_width_px = 4294967297 WHERE id = 1",
             "a recording's size or length is none");
  damaged_by("UPDATE route SET unit = 9e999", "the route's unit or origin is none");
  damaged_by("UPDATE route SET latitude_deg = 91", "the route's unit or origin is none");
  damaged_by("UPDATE descriptor SET width = 4, height = 8 WHERE traverse = 2 AND form = 'pixels'",
             "descriptors of two traverses differ in form");
}

TEST(RouteDatabase, AnyDamageIsAnErrorThatNamesTheFileOrDoesNoHarm) {
  const TemporaryFolder folder;
  const place::Route route = small_route(5);
  place::write_route(folder / "r.db", route);
  const std::string bytes = read_file(folder / "r.db");
  std::size_t errors = 0;
  // A prime, so that the bytes hit do not keep in step with pages; each with its highest and lowest bit.
  constexpr std::size_t kStep = 127;
  for (std::size_t i = 0; i < bytes.size(); i += kStep) {
    for (const char bit : {'\x01', '\x80'}) {
      std::string damaged = bytes;
      damaged[i] = static_cast<char>(damaged[i] ^ bit);
      const auto path = folder.write("d.db", damaged);
      try {
        SCOPED_TRACE(fmt::format("byte {}", i));  // damage that is not found
        expect_equal(place::read_route(path), route);
      } catch (const vo::Error& error) {
        ++errors;
        EXPECT_THAT(error.what(), testing::HasSubstr("d.db: ")) << i;
      } catch (const std::exception& error) {
        ADD_FAILURE() << "byte " << i << ": " << error.what();
      }
    }
  }
  EXPECT_GT(errors, 0U);
  EXPECT_EQ(files_in(folder), 2U);
}

/// Every bit of the bytes that hold the rows of keyframes and settings, where SQLite has no checks.
TEST(RouteDatabase, AFlippedBitInARowIsNamed) {
  const TemporaryFolder folder;
  const place::Route route = small_route(3);
  place::write_route(folder / "r.db", route);
  const std::string bytes = read_file(folder / "r.db");
  const double time_s = route.traverses[0].keyframes[1].time_s;
  std::string written;  // as SQLite stores it, big-endian
  const auto bits = std::bit_cast<std::uint64_t>(time_s);
  for (int shift = 56; shift >= 0; shift -= 8)
    written += static_cast<char>(bits >> static_cast<unsigned>(shift));
  const std::size_t at = bytes.find(written);
  ASSERT_NE(at, std::string::npos) << "a time that SQLite stores as a whole number shows nothing: " << time_s;
  for (std::size_t bit = 0; bit < 64; ++bit) {
    std::string damaged = bytes;
    damaged[at + bit / 8] = static_cast<char>(damaged[at + bit / 8] ^ (1 << (bit % 8)));
    EXPECT_THROW_WITH(place::read_route(folder.write("d.db", damaged)), vo::Error,
                      "d.db: is damaged: rows of its table 'keyframe' have changed");
  }
}

TEST(RouteDatabase, AFailedWriteLeavesTheOldFile) {
  const TemporaryFolder folder;
  place::write_route(folder / "r.db", example_route());
  const std::string before = read_file(folder / "r.db");
  place::Route broken = example_route();
  // SQLite stores no NaN: it becomes NULL, which the column refuses, halfway through writing.
  broken.traverses[1].keyframes[100].time_s = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW_WITH(place::write_route(folder / "r.db", broken), vo::Error, "r.db: ");
  EXPECT_EQ(read_file(folder / "r.db"), before);
  EXPECT_EQ(files_in(folder), 1U);
  EXPECT_THROW_WITH(place::write_route(folder / "none" / "r.db", example_route()), vo::Error, "r.db: ");
  EXPECT_THROW_WITH(place::write_route(folder.path(), example_route()), vo::Error, "is a folder");
}

TEST(RouteDatabase, RefusesTraversesThatDoNotFit) {
  const TemporaryFolder folder;
  const auto refused = [&](const place::Route& route) {
    EXPECT_THROW(place::write_route(folder / "r.db", route), std::invalid_argument);
    EXPECT_EQ(files_in(folder), 0U);
  };
  place::Route route = example_route();
  route.traverses[1].name = "by day";
  refused(route);
  route = example_route();
  route.traverses[0].keyframes.pop_back();
  refused(route);
  route = example_route();
  route.traverses[1].thumbnails.width = 8;
  refused(route);
  route = example_route();
  route.learned.pop_back();
  refused(route);
  route = example_route();
  std::get<place::ColumnStack>(route.traverses[1].descriptors[0]).channels = 10;
  refused(route);
}

TEST(RouteDatabase, LooksLikeARouteByItsFirstBytes) {
  const TemporaryFolder folder;
  const fs::path route = folder.path() / "route.db", other = folder.path() / "walk.mp4";
  place::write_route(route, example_route());
  vo::write_file(other, "SQLite format 2 and more");
  EXPECT_TRUE(place::looks_like_route(route));
  EXPECT_FALSE(place::looks_like_route(other));
  vo::write_file(other, "SQL");
  EXPECT_FALSE(place::looks_like_route(other));
  EXPECT_FALSE(place::looks_like_route(folder.path()));
  EXPECT_FALSE(place::looks_like_route(folder.path() / "none"));
}

TEST(RouteDatabase, ALinkStaysALink) {
  const TemporaryFolder folder;
  place::write_route(folder / "r.db", small_route(3));
  fs::create_symlink(folder / "r.db", folder / "link.db");
  place::write_route(folder / "link.db", small_route(5));
  EXPECT_TRUE(fs::is_symlink(folder / "link.db"));
  EXPECT_EQ(place::read_route(folder / "r.db").traverses[0].keyframes.size(), 5U);
}

TEST(RouteDatabase, WhatAKilledProgramHadBegunIsNotDoneToItsSuccessor) {
  const TemporaryFolder folder;
  place::write_route(folder / "r.db", small_route(3));
  folder.write("r.db-journal", "left behind");
  place::write_route(folder / "r.db", small_route(5));
  EXPECT_FALSE(fs::exists(folder / "r.db-journal"));
  EXPECT_EQ(place::read_route(folder / "r.db").traverses[0].keyframes.size(), 5U);
}

}  // namespace
