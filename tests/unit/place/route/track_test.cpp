#include "support/exif_pictures.hpp"
#include "support/gpmf_pieces.hpp"
#include "support/replaced.hpp"
#include "support/temporary_folder.hpp"
#include "support/video_writer.hpp"

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <place/route/track.hpp>
#include <vo/base/error.hpp>
#include <vo/base/iso_time.hpp>

namespace {

using place::GeographicOrigin;
using test_support::replaced;
using test_support::TemporaryFolder;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr std::string_view kBegin = R"(<?xml version="1.0" encoding="UTF-8"?>
<gpx version="1.1" creator="logger" xmlns="http://www.topografix.com/GPX/1/1">)";

std::string point(double lat, double lon, std::string_view time) {
  return fmt::format("<trkpt lat=\"{}\" lon=\"{}\"><ele>3</ele><time>{}</time></trkpt>\n", lat, lon, time);
}

/// Three points, a second apart, about noon on a day in May.
std::string three(int day = 31, double lat = 51.5) {
  std::string text = "<trkseg>";
  for (int i = 0; i < 3; ++i)
    text += point(lat + 1e-5 * i, -0.25, fmt::format("2024-05-{:02}T12:00:0{}Z", day, i));
  return text + "</trkseg>";
}

std::string gpx(std::string_view tracks) {
  return fmt::format("{}{}</gpx>", kBegin, tracks);
}

place::GeographicTrack read(std::string_view content, const place::TrackOptions& options = {},
                            std::string_view name = "walk.gpx") {
  const TemporaryFolder folder;
  return place::read_track(folder.write(name, content), options);
}

void expect_three(const place::GeographicTrack& track, std::string_view what) {
  EXPECT_THAT(track.time_s, ElementsAre(0, 1, 2)) << what;
  ASSERT_EQ(track.points.size(), 3U) << what;
  EXPECT_DOUBLE_EQ(track.points[2].latitude_deg, 51.5 + 2e-5) << what;
  EXPECT_EQ(track.points[2].longitude_deg, -0.25) << what;
}

TEST(Track, ReadsGpxAsProgramsWriteIt) {
  const std::string plain = gpx("<trk>" + three() + "</trk>");
  const auto reads = [&](const std::string& content, std::string_view name = "walk.gpx") {
    const auto track = read(content, {}, name);
    expect_three(track, content);
    EXPECT_THAT(track.warnings, IsEmpty()) << content;
    EXPECT_EQ(track.start_utc_s, vo::parse_iso_time("2024-05-31T12:00:00Z"));
  };
  reads(plain);
  reads(plain, "WALK.GPX");
  reads(plain, "walk");  // told by its content
  reads("\xEF\xBB\xBF\n" + plain, "walk.txt");
  reads("\xEF\xBB\xBF" + plain);
  reads(replaced(plain, "lat=\"", "lat = \""));
  reads(replaced(plain, "<trkpt", "<!-- <trkpt lat=\"1\" lon=\"2\"></trkpt> --><trkpt"));
  reads(replaced(plain, "12:00:01Z", "14:00:01+02:00"));
  reads(replaced(plain, ":01Z", ":01.000Z"));
  reads(replaced(plain, "<time>", "<time>\n  "));
  std::string prefixed = plain;
  for (const char* name : {"gpx", "trk", "trkseg", "trkpt", "time", "ele"}) {
    for (const char* before : {"<", "</"}) {
      for (const char* after : {">", " "})
        prefixed = replaced(prefixed, fmt::format("{}{}{}", before, name, after),
                            fmt::format("{}g:{}{}", before, name, after));
    }
  }
  reads(replaced(prefixed, "xmlns=", "xmlns:g="));
  std::string utf16 = "\xFF\xFE";
  for (const char c : replaced(plain, "UTF-8", "UTF-16")) utf16 += {c, '\0'};
  reads(utf16);
}

TEST(Track, DegreesMayHaveDecimalCommas) {
  expect_three(read(gpx("<trk>" + replaced(three(), "\"-0.25\"", "\"-0,25\"") + "</trk>")), "commas");
}

TEST(Track, LeavesOutBadPointsAndSaysSo) {
  const std::string bad = point(51.5, -0.25, "") +  // untimed
                          "<trkpt lat=\"\" lon=\"\"><time>2024-05-31T12:00:01Z</time></trkpt>" +
                          point(95, -0.25, "2024-05-31T12:00:01Z") +
                          point(0, 0, "2024-05-31T11:59:59Z") +  // before the receiver knew where it was
                          point(51.6, -0.25, "2024-05-31T12:00:02Z");  // a second point at that time
  const auto track = read(gpx("<trk>" + three() + "<trkseg>" + bad + "</trkseg></trk>"));
  expect_three(track, "bad points");
  EXPECT_THAT(track.warnings,
              ElementsAre(HasSubstr("5 of 8 points are left out: 3 without a place, 1 without a time, 1 at a "
                                    "time that is there already")));
}

TEST(Track, SegmentsComeInOrderOfTime) {
  const std::string late = "<trkseg>" + point(52, 0, "2024-05-31T13:00:00Z") + "</trkseg>";
  const auto track = read(gpx("<trk>" + late + three() + "</trk>"));
  EXPECT_THAT(track.time_s, ElementsAre(0, 1, 2, 3600));
  ASSERT_EQ(track.segment.size(), 4U);
  EXPECT_EQ(track.segment[0], track.segment[2]);
  EXPECT_NE(track.segment[2], track.segment[3]);
  EXPECT_EQ(track.points[3].latitude_deg, 52);
}

TEST(Track, ChoosesAmongSeveral) {
  const std::string content = gpx("<trk><name>today</name>" + three(31) +
                                  "</trk><trk><name>yesterday</name>" + three(30, 40) + "</trk>");
  const auto latest = read(content);
  expect_three(latest, "the latest");
  EXPECT_THAT(latest.warnings,
              ElementsAre(HasSubstr("has 2 tracks ('today' of 2024-05-31T12:00:00.000Z, 'yesterday' of "
                                    "2024-05-30T12:00:00.000Z); 'today' is taken, the latest; choose another "
                                    "by --track-name")));
  EXPECT_EQ(read(content, {.track_name = "yesterday"}).points[0].latitude_deg, 40);
  EXPECT_EQ(read(content, {.track_name = "2"}).points[0].latitude_deg, 40);
  EXPECT_THAT(read(content, {.track_name = "2"}).warnings, IsEmpty());
  EXPECT_THROW_WITH(read(content, {.track_name = "tomorrow"}), vo::Error,
                    "has no track 'tomorrow'; expected one of 'today', 'yesterday'");
  const auto during = read(
      content, {.video_start_utc_s = vo::parse_iso_time("2024-05-30T12:00:01Z"), .video_duration_s = 60});
  EXPECT_EQ(during.points[0].latitude_deg, 40);
  EXPECT_THAT(during.warnings, ElementsAre(HasSubstr("'yesterday' is taken, recorded during the video")));
}

TEST(Track, UsesWhatThereIsOfAFileThatIsCutOff) {
  const std::string whole = gpx("<trk>" + three() + "</trk>");
  const auto track = read(whole.substr(0, whole.find("</trkseg>")));
  expect_three(track, "cut off");
  EXPECT_THAT(track.warnings, ElementsAre(HasSubstr("is cut off or broken")));
}

TEST(Track, RefusesWhatIsNoTrack) {
  const auto refused = [](std::string_view content, const char* says, std::string_view name = "walk.gpx") {
    EXPECT_THROW_WITH(read(content, {}, name), vo::Error, says);
  };
  refused(gpx(""), "walk.gpx: has no track");
  refused(gpx("<rte><rtept lat=\"1\" lon=\"2\"/></rte>"), "has a route and no track");
  refused(gpx("<wpt lat=\"1\" lon=\"2\"/>"), "has waypoints and no track");
  refused(gpx("<trk><trkseg></trkseg></trk>"), "has 0 usable points of 0");
  refused(gpx("<trk><trkseg>" + point(1, 2, "2024-05-31T12:00:00Z") + "</trkseg></trk>"),
          "1 usable points of 1");
  refused(gpx("<trk><trkseg>" + point(1, 2, "") + point(1, 2, "") + "</trkseg></trk>"), "has no times");
  refused("this is text", "is no XML");
  refused("", "is no XML");
  EXPECT_THROW_WITH(place::read_track("nowhere.gpx"), vo::Error, "nowhere.gpx: cannot be read");
}

TEST(Track, ReadsCsv) {
  const auto track = read("lon_deg;time_s;lat_deg\n7;0,5;46\n7,1;1,5;46,1\n", {}, "walk.csv");
  EXPECT_THAT(track.time_s, ElementsAre(0.5, 1.5));
  EXPECT_EQ(track.points[1].latitude_deg, 46.1);
  EXPECT_FALSE(track.start_utc_s);
  // A ten-thousandth of a degree is 11 m north.
  const auto milliseconds =
      read("time_s,lat_deg,lon_deg\n0,46,7\n10000,46.0001,7\n20000,46.0002,7\n", {}, "walk.csv");
  EXPECT_THAT(milliseconds.time_s, ElementsAre(0, 10, 20));
  EXPECT_THAT(milliseconds.warnings, ElementsAre(HasSubstr("times in milliseconds, converted")));
  const auto dated =
      read("time_s,lat_deg,lon_deg\n'1717156800','46','7'\n'1717156801','46','7'\n", {}, "walk.csv");
  EXPECT_THAT(dated.time_s, ElementsAre(0, 1));
  EXPECT_EQ(dated.start_utc_s, 1717156800);
  const auto iso =
      read("Time,Lat,Lon\n2024-05-31T12:00:00Z,46,7\n2024-05-31T14:00:01+02:00,46,7\n", {}, "walk.csv");
  EXPECT_THAT(iso.time_s, ElementsAre(0, 1));
  EXPECT_EQ(iso.start_utc_s, 1717156800);
  EXPECT_THROW_WITH(read("time_s,lat_deg\n1,2\n", {}, "walk.csv"), vo::Error, "longitude_deg");
  const auto bad = read("time_s,lat_deg,lon_deg\n1,2,3\n1,2,3\n2,95,3\n3,2,3\n4,x,3\n", {}, "walk.csv");
  EXPECT_THAT(bad.time_s, ElementsAre(1, 3));
  EXPECT_THAT(bad.warnings, ElementsAre(HasSubstr("3 of 5 points are left out: 2 without a place")));
  EXPECT_THROW_WITH(read("time_s,lat_deg,lon_deg\n1,2,3\n2,2,3\n", {.track_name = "a"}, "walk.csv"),
                    vo::Error, "is no GPX file");
}

TEST(Track, ReadsWhatACameraRecordsBesideItsPictures) {
  const TemporaryFolder folder;
  test_support::write_video(folder / "GX01.MP4", 50,
                            {.telemetry = {test_support::gps5_piece({{51.5, -0.25}, {51.5 + 1e-5, -0.25}}),
                                           test_support::gps5_piece({{0, 0}}, 0),
                                           test_support::gps5_piece({{51.5 + 2e-5, -0.25}})}});
  const place::GeographicTrack track = place::read_track(folder / "GX01.MP4");
  ASSERT_EQ(track.time_s.size(), 3U);
  EXPECT_NEAR(track.time_s[1], 0.5, 0.001);
  EXPECT_NEAR(track.time_s[2], 2, 0.001);
  EXPECT_NEAR(track.points[2].latitude_deg, 51.5 + 2e-5, 1e-7);
  EXPECT_FALSE(track.start_utc_s);
  EXPECT_THAT(track.warnings, ElementsAre(HasSubstr("1 of 4 points are left out: 1 without a place")));
  EXPECT_THROW_WITH(place::read_track(folder / "GX01.MP4", {.track_name = "1"}), vo::Error,
                    "no --track-name");
}

TEST(Track, ReadsWhatToGpxWrites) {
  const GeographicOrigin origin{46, 7};
  const vo::Trajectory walk{{0.5, {0, 0, 0}}, {1.5, {10, 20, 0}}, {2.25, {12, 20, 0}}};
  const auto dated = read(place::to_gpx(walk, origin, 1e9));
  EXPECT_THAT(dated.time_s, ElementsAre(0, 1, 1.75));
  EXPECT_EQ(dated.start_utc_s, 1e9 + 0.5);
  const std::vector<std::optional<double>> probability(walk.size(), 0.5);  // an extension is skipped
  const auto undated = read(place::to_gpx(walk, origin, {}, probability));
  EXPECT_THAT(undated.time_s, ElementsAre(0.5, 1.5, 2.25));  // since the walk's first frame
  EXPECT_FALSE(undated.start_utc_s);
  const vo::Trajectory back = place::local_trajectory(undated, origin);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(back[i].pose.x_m, walk[i].pose.x_m, 0.01);  // a centimetre
    EXPECT_NEAR(back[i].pose.y_m, walk[i].pose.y_m, 0.01);
  }
}

TEST(Track, HeadingsAreItsDirections) {
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

TEST(Track, HeadingsDoNotLookAcrossSegments) {
  // East on one street, then east on one 100 m to the north.
  const GeographicOrigin origin{48, 11};
  place::GeographicTrack track;
  for (int i = 0; i < 20; ++i) {
    track.time_s.push_back(i);
    track.points.push_back(place::geographic_at(origin, 2.0 * i, i < 10 ? 0 : 100));
    track.segment.push_back(i < 10 ? 0 : 1);
  }
  for (const auto& pose : place::local_trajectory(track, origin))
    EXPECT_NEAR(pose.pose.heading_rad, std::numbers::pi / 2, 1e-6) << pose.time_s;
}

TEST(Track, IsThatOfTheWalksPictures) {
  const TemporaryFolder folder;
  const cv::Mat picture(8, 16, CV_8UC1, cv::Scalar(90));
  test_support::write_exif_picture(folder / "1.jpg", picture, {.position_deg = {{51.5, -0.25}}});
  test_support::write_exif_picture(folder / "2.jpg", picture, {});
  test_support::write_exif_picture(folder / "10.jpg", picture, {.position_deg = {{51.75, -0.5}}});
  const place::GeographicTrack track = place::read_track(folder.path(), {.picture_time_s = {0, 0.5, 1}});
  EXPECT_THAT(track.time_s, ElementsAre(0, 1));
  EXPECT_DOUBLE_EQ(track.points[1].latitude_deg, 51.75);
  EXPECT_DOUBLE_EQ(track.points[1].longitude_deg, -0.5);
  EXPECT_THAT(track.warnings, ElementsAre(HasSubstr("1 of 3 points are left out: 1 without a place")));
  EXPECT_THROW(place::read_track(folder.path(), {.picture_time_s = {0, 1}}), vo::Error)
      << "a picture that could not be read: which place is whose is not known";
  EXPECT_THROW(place::read_track(folder.path(), {.track_name = "1", .picture_time_s = {0, 0.5, 1}}),
               vo::Error);
}

}  // namespace
