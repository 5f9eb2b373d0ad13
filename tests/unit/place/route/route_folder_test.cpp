#include "place/route/route_folder.hpp"

#include "support/example_route.hpp"
#include "support/temporary_folder.hpp"

#include <filesystem>
#include <fstream>
#include <string>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <place/describe/npy.hpp>
#include <place/route/route_database.hpp>
#include <vo/base/error.hpp>
#include <vo/io/atomic_file.hpp>

namespace {

namespace fs = std::filesystem;
using test_support::example_route;
using test_support::expect_equal;
using test_support::read_file;
using test_support::TemporaryFolder;
using testing::HasSubstr;

/// What reading the folder says.
std::string refusal(const fs::path& folder) {
  try {
    place::read_route_folder(folder);
  } catch (const vo::Error& error) {
    return error.what();
  }
  return "";
}

TEST(RouteFolder, RoundTripsEverythingToTheSameDatabase) {
  const TemporaryFolder folder;
  place::Route route = example_route();
  route.traverses[3].view_points = {{1, 2, 3}};
  for (std::size_t i = 0; i < 256; ++i)
    route.traverses[1].view_points.push_back(place::Bytes(i % 3, static_cast<std::uint8_t>(i)));
  place::write_route_folder(folder / "out", route);
  const place::Route back = place::read_route_folder(folder / "out");
  expect_equal(back, route);
  // Equal routes give equal bytes, so this compares what expect_equal might forget.
  place::write_route(folder / "a.db", route);
  place::write_route(folder / "b.db", back);
  EXPECT_EQ(read_file(folder / "a.db"), read_file(folder / "b.db"));
}

TEST(RouteFolder, ARouteWithoutTraverses) {
  const TemporaryFolder folder;
  place::write_route_folder(folder / "out", place::Route());
  expect_equal(place::read_route_folder(folder / "out"), place::Route());
}

TEST(RouteFolder, OthersReadThePartsTheyWant) {
  const TemporaryFolder folder;
  place::write_route_folder(folder / "out", example_route());
  const fs::path night = folder / "out" / "traverse-2";
  const place::FloatRows columns = place::read_npy(night / "descriptors-1.npy");
  EXPECT_EQ(columns.size(), 256U);
  EXPECT_EQ(columns.width, 10U);
  EXPECT_EQ(columns.values[127], (2 * 127) % 255 - 127.0F);                          // as the example is made
  EXPECT_EQ(read_file(night / "preview-000028.jpg"), std::string("\0\xff\x04", 3));  // the fifth keyframe's
  EXPECT_THAT(read_file(folder / "out" / "traverses.csv"),
              HasSubstr("2,by night,\"by night's \"\"walk\"\" ü.mp4\""));
}

TEST(RouteFolder, LeavesNothingWhereItCannotWrite) {
  const TemporaryFolder folder;
  vo::write_file(folder / "file", "x");
  EXPECT_THROW(place::write_route_folder(folder / "file", example_route()), vo::Error);
  fs::create_directory(folder / "full");
  vo::write_file(folder / "full" / "x", "x");
  EXPECT_THROW(place::write_route_folder(folder / "full", example_route()), vo::Error);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), {}), 2);
  fs::create_directory(folder / "empty");
  place::write_route_folder(folder / "empty", example_route());
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), {}), 3);
}

TEST(RouteFolder, SaysWhichFileDoesNotFit) {
  const TemporaryFolder folder;
  const fs::path out = folder / "out";
  EXPECT_THAT(refusal(out), HasSubstr("out: is no folder"));
  place::write_route_folder(out, example_route());
  const auto with = [&](const fs::path& file, const std::string& content) {
    const std::string before = read_file(file);
    vo::write_file(file, content);
    std::string message = refusal(out);
    vo::write_file(file, before);
    return message;
  };
  const fs::path day = out / "traverse-1";
  EXPECT_THAT(with(out / "route.csv", "name,value\nformat,2\n"),
              HasSubstr("route.csv: is of another format"));
  EXPECT_THAT(with(out / "route.csv", "name,value\nformat,1\n"), HasSubstr("route.csv: has no 'unit'"));
  EXPECT_THAT(with(out / "settings.csv", "traverse,name,value\n0,sampling-m,3\n"),
              HasSubstr("settings.csv: line 2: sampling-m"));
  EXPECT_THAT(with(out / "descriptors.csv", "descriptor,form,width,height\n"),
              HasSubstr("descriptors.csv: names 0 descriptors; expected 3"));
  EXPECT_THAT(with(day / "keyframes.csv", read_file(out / "traverse-4" / "keyframes.csv")),
              HasSubstr("600 x"));  // one keyframe, and descriptors of six hundred
  for (const float value : {200.0F, -129.0F, 0.5F, 1e30F}) {
    place::write_npy(folder / "other.npy",
                     place::FloatRows{.width = 10, .values = std::vector<float>(6000, value)});
    EXPECT_THAT(with(day / "descriptors-1.npy", read_file(folder / "other.npy")),
                HasSubstr(fmt::format("descriptors-1.npy: holds {}; expected int8", value)));
  }
  fs::remove(day / "preview-000000.jpg");
  EXPECT_THAT(refusal(out), HasSubstr("preview-000000.jpg: cannot be read"));
}

}  // namespace
