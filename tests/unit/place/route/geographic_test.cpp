#include "support/temporary_folder.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <place/route/geographic.hpp>
#include <vo/base/error.hpp>

namespace {

using place::GeographicOrigin;
using test_support::TemporaryFolder;

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

TEST(Geographic, ReadsTracks) {
  const TemporaryFolder folder;
  const auto gpx =
      place::read_track(folder.write("a.gpx",
                                     "<gpx><trk><trkseg>"
                                     "<trkpt lat=\"51.5\" lon='-0.25'><ele>3</ele>"
                                     "<time>2024-02-28T23:59:59.5Z</time></trkpt>\n"
                                     "<trkpt lon=\"-0.26\" lat=\"51.6\"><time>2024-03-01T00:00:01Z</time>"
                                     "</trkpt></trkseg></trk></gpx>"));
  ASSERT_EQ(gpx.points.size(), 2U);
  EXPECT_EQ(gpx.time_s[0], 0);
  EXPECT_EQ(gpx.time_s[1], 86400 + 1.5);  // the 29th of a leap year
  EXPECT_EQ(gpx.points[1].latitude_deg, 51.6);
  EXPECT_EQ(gpx.points[0].longitude_deg, -0.25);
  const auto csv =
      place::read_track(folder.write("a.csv", "lon_deg,time_s,lat_deg\n7,0.5,46\n7.1,1.5,46.1\n"));
  EXPECT_EQ(csv.time_s, (std::vector<double>{0.5, 1.5}));
  EXPECT_EQ(csv.points[1].latitude_deg, 46.1);
}

TEST(Geographic, SaysWhatIsWrongWithATrack) {
  const TemporaryFolder folder;
  EXPECT_THROW_WITH(place::read_track(folder.write("a.gpx", "<gpx></gpx>")), vo::Error,
                    "a.gpx: has 0 points");
  EXPECT_THROW_WITH(place::read_track(folder.write(
                        "b.gpx", "<trkpt lat=\"1\" lon=\"x\"><time>2024-01-01T00:00:00Z</time>")),
                    vo::Error, "b.gpx: track point 1: has no place");
  EXPECT_THROW_WITH(place::read_track(folder.write("c.gpx", "<trkpt lat=\"1\" lon=\"2\"></trkpt>")),
                    vo::Error, "c.gpx: track point 1: has no time");
  // A point closed at once does not take the next one's time.
  EXPECT_THROW_WITH(place::read_track(folder.write("self_closed.gpx",
                                                   "<trkpt lat=\"1\" lon=\"2\"/><trkpt lat=\"1\" lon=\"2\">"
                                                   "<time>2024-01-01T00:00:00Z</time></trkpt>")),
                    vo::Error, "self_closed.gpx: track point 1: has no time");
  EXPECT_THROW_WITH(place::read_track("nowhere.gpx"), vo::Error, "nowhere.gpx: cannot be read");
  EXPECT_THROW_WITH(place::read_track(folder.write("d.csv", "time_s,lat_deg\n1,2\n")), vo::Error,
                    "longitude_deg");
  EXPECT_THROW_WITH(place::read_track(folder.write("e.csv", "time_s,lat_deg,lon_deg\n1,2,3\n1,2,3\n")),
                    vo::Error, "e.csv: point 2 is not later");
  EXPECT_THROW_WITH(place::read_track(folder.write("f.csv", "time_s,lat_deg,lon_deg\n1,95,3\n2,2,3\n")),
                    vo::Error, "f.csv: point 1 is at 95, 3");
}

TEST(Geographic, ATracksHeadingsAreItsDirections) {
  // Two metres east a second, then north, with a receiver that jitters by 0.2 m.
  const GeographicOrigin origin{48, 11};
  place::GeographicTrack track;
  for (int i = 0; i <= 40; ++i) {
    const double jitter = i % 2 == 0 ? 0.1 : -0.1;
    const double x = i <= 20 ? 2.0 * i : 40 + jitter, y = i <= 20 ? jitter : 2.0 * (i - 20);
    track.time_s.push_back(i);
    track.points.push_back(place::geographic_at(origin, x, y));
  }
  const vo::Trajectory poses = place::local_trajectory(track, origin, 8);
  // A jitter of 0.2 m over 8 m, 0.025 rad.
  EXPECT_NEAR(poses[10].pose.heading_rad, std::numbers::pi / 2, 0.03);
  EXPECT_NEAR(poses[0].pose.heading_rad, std::numbers::pi / 2, 0.06);
  EXPECT_NEAR(poses[30].pose.heading_rad, 0, 0.03);
  EXPECT_NEAR(poses[30].pose.y_m, 20, 1e-6);
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
  const TemporaryFolder folder;
  const std::string gpx = place::to_gpx(walk, {46, 7});
  EXPECT_THAT(gpx, testing::StartsWith("<?xml"));
  EXPECT_THAT(gpx, testing::HasSubstr(fmt::format("<trkpt lat=\"{:.7f}\" lon=\"{:.7f}\">", end.latitude_deg,
                                                  end.longitude_deg)));
}

}  // namespace
