#include "support/temporary_folder.hpp"

#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <place/route/named_places.hpp>
#include <vo/base/error.hpp>

namespace {

/// A keyframe every ten frames and every half metre, from 3 m on, to the north, `east_m` aside.
place::Traverse straight(const std::string& name, double east_m = 0, std::size_t keyframes = 21) {
  place::Traverse traverse;
  traverse.name = name;
  traverse.source = name + ".mp4";
  for (std::size_t k = 0; k < keyframes; ++k) {
    const double along_m = 0.5 * static_cast<double>(k);
    place::Keyframe& keyframe = traverse.keyframes.emplace_back();
    keyframe.frame = static_cast<std::int64_t>(10 * k);
    keyframe.distance_m = 3 + along_m;
    keyframe.pose = vo::Pose2{east_m, along_m, 0};
  }
  traverse.frames = static_cast<std::int64_t>(10 * keyframes);
  return traverse;
}

class NamedPlacesTest : public testing::Test {
 protected:
  [[nodiscard]] std::filesystem::path file(const std::string& text) const {
    return folder_.write("names.csv", text);
  }
  std::vector<place::NamedPlace> read(const std::string& text, const place::Traverse& traverse) {
    return place::named_places(place::read_place_names(file(text)), traverse);
  }
  std::string refusal(const std::string& text, const place::Traverse& traverse = straight("day")) {
    try {
      read(text, traverse);
    } catch (const vo::Error& error) {
      return error.what();
    }
    return "";
  }

  test_support::TemporaryFolder folder_;
};

TEST_F(NamedPlacesTest, FindsDistancesOfFramesAndFramesOfDistances) {
  const auto by_frame = read("frame,name\n45,bakery\n0,\"door, green\"\n", straight("day"));
  ASSERT_EQ(by_frame.size(), 2U);
  EXPECT_EQ(by_frame[0].name, "door, green");  // in order of frames
  EXPECT_EQ(by_frame[0].distance_m, 3);
  EXPECT_EQ(by_frame[1].frame, 45);
  EXPECT_DOUBLE_EQ(*by_frame[1].distance_m, 3 + 4.5 * 0.5);

  const auto by_distance = read("distance_m,name\n5.25,bakery\n", straight("day"));
  ASSERT_EQ(by_distance.size(), 1U);
  EXPECT_EQ(by_distance[0].frame, 45);
  EXPECT_EQ(by_distance[0].distance_m, 5.25);
}

TEST_F(NamedPlacesTest, TakesFramesOfAWalkWithoutASurvey) {
  place::Traverse bare = straight("day");
  for (auto& keyframe : bare.keyframes) keyframe.distance_m.reset();
  const auto places = read("frame,name\n45,bakery\n", bare);
  EXPECT_EQ(places.at(0).frame, 45);
  EXPECT_FALSE(places.at(0).distance_m);
  EXPECT_THAT(refusal("distance_m,name\n5,bakery\n", bare), testing::HasSubstr("line 2: gives a distance"));
}

TEST_F(NamedPlacesTest, SaysWhatIsWrong) {
  using testing::HasSubstr;
  EXPECT_THAT(refusal("place,name\n1,x\n"), HasSubstr("has the columns place,name"));
  EXPECT_THAT(refusal("frame,distance_m,name\n1,4,x\n"), HasSubstr("frame,name or distance_m,name"));
  EXPECT_THAT(refusal("frame,name\n"), HasSubstr("names no place"));
  EXPECT_THAT(refusal("frame,name\n1,x\n2,\n"), HasSubstr("line 3: has no name"));
  EXPECT_THAT(refusal("frame,name\n-1,x\n"), HasSubstr("line 2"));
  EXPECT_THAT(refusal("frame,name\n210,x\n"), HasSubstr("line 2: names frame 210; expected 0 to 209"));
  EXPECT_THAT(refusal("distance_m,name\n2.9,x\n"),
              HasSubstr("line 2: names the place at 2.9 m; expected 3 to 13"));
  EXPECT_THAT(refusal("distance_m,name\n13.5,x\n"), HasSubstr("names the place at 13.5 m"));
  EXPECT_THAT(refusal("distance_m,name\nnan,x\n"), HasSubstr("line 2"));
  EXPECT_THAT(refusal("frame,name\n1,caf\xE9\n"), HasSubstr("line 2: has a name that is not UTF-8"));
  EXPECT_THAT(refusal("frame,name\n1,a\x1B[31mb\n"), HasSubstr("control characters"));
  EXPECT_THAT(refusal("frame,name\n1," + std::string(201, 'x') + "\n"), HasSubstr("201 bytes"));
  EXPECT_EQ(refusal("frame,name\n1,caf\xC3\xA9 \xF0\x9F\x8D\x9E\n"), "");
}

TEST(PlacesOn, SeesPlacesOfAnotherWalkByPoses) {
  place::Route route;
  route.traverses = {straight("day"), straight("night", 1), straight("far", 5)};
  route.traverses[0].places = {{"bakery", 40, 5}, {"gate", 100, 8}};
  route.traverses[1].places = {{"gate", 90, 7.5}};
  const auto own = place::places_on(route, 0);
  ASSERT_EQ(own.size(), 2U);  // its own gate is the other's
  EXPECT_DOUBLE_EQ(own[0].keyframe, 4);
  EXPECT_DOUBLE_EQ(own[1].keyframe, 10);
  const auto other = place::places_on(route, 1);
  ASSERT_EQ(other.size(), 2U);
  EXPECT_EQ(other[0].traverse, 0U);
  EXPECT_EQ(other[0].index, 0U);
  EXPECT_DOUBLE_EQ(other[0].keyframe, 4);
  EXPECT_EQ(other[1].traverse, 1U);
  EXPECT_TRUE(place::places_on(route, 2).empty());
}

TEST(PlacesOn, KeepsToItsOwnWithoutASurvey) {
  place::Route route;
  route.traverses = {straight("day"), straight("night")};
  for (auto& traverse : route.traverses) traverse.surveyed = false;
  route.traverses[0].places = {{"bakery", 40, {}}};
  EXPECT_EQ(place::places_on(route, 0).size(), 1U);
  EXPECT_TRUE(place::places_on(route, 1).empty());
}

TEST(PlacesOn, PassesOverAWalkWithoutKeyframes) {
  place::Route route;
  route.traverses = {straight("day"), straight("none", 0, 0)};
  route.traverses[1].places = {{"bakery", 40, {}}};
  EXPECT_TRUE(place::places_on(route, 0).empty());
  EXPECT_TRUE(place::places_on(route, 1).empty());
}

}  // namespace
