#include "support/exif_pictures.hpp"
#include "support/temporary_folder.hpp"

#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vo/base/error.hpp>
#include <vo/io/frame_source.hpp>
#include <vo/io/picture_tags.hpp>

namespace {

using test_support::Exif;
using test_support::TemporaryFolder;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr double kNoon = 1717156800;  // 2024-05-31 12:00:00 UTC: date -u -d 2024-05-31T12:00:00 +%s

vo::PictureTags tags_of(const Exif& exif) {
  const TemporaryFolder folder;
  test_support::write_exif_picture(folder / "1.jpg", cv::Mat(8, 16, CV_8UC1, cv::Scalar(90)), exif);
  return vo::read_picture_tags(folder / "1.jpg");
}

TEST(PictureTags, AreTheTimeAndThePlace) {
  const vo::PictureTags tags = tags_of({.time = "2024:05:31 14:00:00",
                                        .fraction = "25",
                                        .zone = "+02:00",
                                        .position_deg = {{-33.8688, 151.2093}}});
  EXPECT_DOUBLE_EQ(tags.time_s.value(), kNoon + 0.25);
  EXPECT_TRUE(tags.utc);
  EXPECT_NEAR(tags.position_deg.value().first, -33.8688, 1e-8);  // a hundred-thousandth of a second of arc
  EXPECT_NEAR(tags.position_deg.value().second, 151.2093, 1e-8);
}

TEST(PictureTags, WithoutAZoneTheCamerasClockIsTakenForUtc) {
  const vo::PictureTags tags = tags_of({.time = "2024:05:31 12:00:00"});
  EXPECT_DOUBLE_EQ(tags.time_s.value(), kNoon);
  EXPECT_FALSE(tags.utc);
  EXPECT_FALSE(tags.position_deg);
}

TEST(PictureTags, ThatSayNothingHaveNoValue) {
  EXPECT_FALSE(tags_of({}).time_s);
  EXPECT_FALSE(tags_of({.time = "    :  :     :  :  "}).time_s) << "a clock that was never set";
  EXPECT_FALSE(tags_of({.time = "0000:00:00 00:00:00"}).time_s);
  EXPECT_FALSE(tags_of({.position_deg = {{91, 0}}}).position_deg) << "no latitude";
  const TemporaryFolder folder;
  EXPECT_FALSE(vo::read_picture_tags(folder.write("text.jpg", "no picture")).time_s);
  try {
    vo::read_picture_tags(folder / "missing.jpg");
    ADD_FAILURE() << "a missing file was read";
  } catch (const vo::Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("missing.jpg"));
  }
}

TEST(PictureTags, DamagedDataAreLeftOut) {
  const std::string whole =
      test_support::exif_data({.time = "2024:05:31 12:00:00", .position_deg = {{1, 2}}});
  const TemporaryFolder folder;
  const std::filesystem::path path = folder / "1.jpg";
  test_support::write_exif_picture(path, cv::Mat(8, 16, CV_8UC1, cv::Scalar(90)),
                                   {.time = "2024:05:31 12:00:00", .position_deg = {{1, 2}}});
  std::ifstream file(path, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(file), {}};
  for (std::size_t cut = 0; cut < whole.size() + 20; cut += 3)
    EXPECT_NO_THROW(vo::read_picture_tags(folder.write("cut.jpg", bytes.substr(0, cut)))) << cut;
  for (std::size_t at = 2; at < whole.size() + 12; ++at) {
    for (const int value : {0, 0x7F, 0xFF}) {
      std::string damaged = bytes;
      damaged[at] = static_cast<char>(value);
      EXPECT_NO_THROW(vo::read_picture_tags(folder.write("hit.jpg", damaged))) << at;
    }
  }
}

std::vector<vo::PictureTags> at(const std::vector<double>& times_s) {
  std::vector<vo::PictureTags> tags;
  for (const double time_s : times_s) tags.push_back({.time_s = kNoon + time_s});
  return tags;
}

TEST(PictureTimes, OfPicturesOfOneSecondAreSpreadOverIt) {
  // Three in the first second, one in the second, then a pause, and two in the last one.
  EXPECT_THAT(vo::picture_times_s({"a", "b", "c", "d", "e", "f"}, at({0, 0, 0, 1, 60, 60})),
              ElementsAre(testing::DoubleEq(0), testing::DoubleNear(1 / 3., 1e-12),
                          testing::DoubleNear(2 / 3., 1e-12), testing::DoubleEq(1), testing::DoubleEq(60),
                          testing::DoubleEq(60.5)));
  EXPECT_THAT(vo::picture_times_s({"a", "b"}, at({0, 0.25})), ElementsAre(0, 0.25));
  EXPECT_THAT(vo::picture_times_s({"a"}, at({5})), ElementsAre(0));
}

TEST(PictureTimes, NameThePictureWithoutATime) {
  try {
    vo::picture_times_s({"a.jpg", "b.jpg"}, {{.time_s = 1}, {}});
    ADD_FAILURE();
  } catch (const vo::Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("b.jpg: has no time"));
  }
  try {
    vo::picture_times_s({"a.jpg", "b.jpg"}, at({1, 0}));
    ADD_FAILURE();
  } catch (const vo::Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("b.jpg: was taken before"));
  }
}

TEST(PictureTimes, AreThoseOfTheFolder) {
  const TemporaryFolder folder;
  const char* const times[] = {"2024:05:31 14:00:00", "2024:05:31 14:00:01", "2024:05:31 14:00:04"};
  for (int i = 0; i < 3; ++i)
    test_support::write_exif_picture(folder / (std::to_string(i) + ".jpg"),
                                     cv::Mat(8, 16, CV_8UC1, cv::Scalar(90 + i)),
                                     {.time = times[i], .zone = "+02:00"});
  const auto source = vo::open_frame_source(folder.path().string(), {.exif_times = true});
  std::vector<double> read_s;
  while (const auto frame = source->next()) read_s.push_back(frame->time_s);
  EXPECT_THAT(read_s, ElementsAre(0, 1, 4));
  EXPECT_EQ(source->start_utc_s(), kNoon);
  EXPECT_THROW(vo::open_frame_source(folder.path().string(), {.frame_rate_hz = 5, .exif_times = true}),
               vo::Error);
  EXPECT_THROW(vo::open_frame_source((folder / "0.jpg").string(), {.exif_times = true}), vo::Error);
}

}  // namespace
