#include <cmath>
#include <stdexcept>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <place/route/geographic.hpp>

namespace {

using place::GeographicOrigin;

TEST(Geographic, DegreesAreAsLongAsTablesSay) {
  // Lengths of a degree on WGS 84: at the equator 110574 m by 111320 m, at 60 degrees 111412 m by 55800 m.
  EXPECT_NEAR(place::local_at({0, 0}, {1, 1}).y_m, 110574, 1);
  EXPECT_NEAR(place::local_at({0, 0}, {1, 1}).x_m, 111320, 1);
  EXPECT_NEAR(place::local_at({60, 10}, {61, 11}).y_m, 111412, 1);
  EXPECT_NEAR(place::local_at({60, 10}, {61, 11}).x_m, 55800, 1);
  EXPECT_NEAR(place::local_at({60, 179.5}, {60, -179.5}).x_m, 55800, 1);  // over the date line
}

TEST(Geographic, ThereAndBack) {
  for (const GeographicOrigin& origin : {GeographicOrigin{33.1268, -117.3274}, {-80, 179.9999}, {0, 0}}) {
    const auto point = place::geographic_at(origin, 1234.5, -987.6);
    const vo::Pose2 back = place::local_at(origin, point);
    EXPECT_NEAR(back.x_m, 1234.5, 1e-6);
    EXPECT_NEAR(back.y_m, -987.6, 1e-6);
  }
  EXPECT_THROW(place::local_at({89.5, 0}, {}), std::invalid_argument);
}

TEST(Geographic, WritesWhatMapsRead) {
  const vo::Trajectory walk{{0, {0, 0, 0}}, {1.5, {10, 20, 0}}};
  const auto end = place::geographic_at({46, 7}, 10, 20);
  const std::string geojson = place::to_geojson(walk, {46, 7});
  EXPECT_EQ(geojson,
            fmt::format(
                "{{\"type\":\"Feature\",\"properties\":{{\"time_s\":[0.000,1.500]}},\"geometry\":{{\"type\":"
                "\"LineString\",\"coordinates\":[[7.0000000,46.0000000],[{:.7f},{:.7f}]]}}}}\n",
                end.longitude_deg, end.latitude_deg));
  const std::string gpx = place::to_gpx(walk, {46, 7}, 1e9);
  EXPECT_THAT(gpx, testing::StartsWith("<?xml"));
  EXPECT_THAT(gpx, testing::HasSubstr(fmt::format(
                       "<trkpt lat=\"{:.7f}\" lon=\"{:.7f}\"><time>2001-09-09T01:46:41.500Z</time></trkpt>",
                       end.latitude_deg, end.longitude_deg)));
  EXPECT_THAT(gpx, testing::Not(testing::HasSubstr("first frame")));
  EXPECT_THAT(place::to_gpx(walk, {46, 7}), testing::HasSubstr("Times count from the walk's first frame."));
}

TEST(Geographic, WritesHowSureEachPoseIs) {
  const vo::Trajectory walk{{0, {0, 0, 0}}, {1.5, {10, 20, 0}}};
  const std::vector<std::optional<double>> probability{0.98765, std::nullopt};
  EXPECT_THAT(place::to_geojson(walk, {46, 7}, probability),
              testing::HasSubstr(R"("properties":{"time_s":[0.000,1.500],"probability":[0.9877,null]})"));
  const std::string gpx = place::to_gpx(walk, {46, 7}, 1e9, probability);
  EXPECT_THAT(gpx, testing::HasSubstr("</time><extensions><retrace:probability>0.9877</retrace:probability>"
                                      "</extensions></trkpt>"));
  EXPECT_THAT(gpx, testing::HasSubstr("</time></trkpt>"));
  EXPECT_THAT(gpx, testing::HasSubstr("xmlns:retrace="));
  const std::vector<std::optional<double>> one{0.5};
  EXPECT_THROW(place::to_geojson(walk, {46, 7}, one), std::invalid_argument);
  EXPECT_THROW(place::to_gpx(walk, {46, 7}, {}, one), std::invalid_argument);
}

}  // namespace
