#include <stdexcept>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vo/tracks/tracking_window.hpp>

namespace {

using testing::ElementsAre;

vo::Feature at(float x_px) {
  vo::Feature feature;
  feature.x_px = x_px;
  return feature;
}

std::vector<float> from_of(const vo::Tracks& tracks) {
  std::vector<float> all;
  for (const vo::TrackedPoint& point : tracks.points) all.push_back(point.from.x_px);
  return all;
}

std::vector<float> to_of(const vo::Tracks& tracks) {
  std::vector<float> all;
  for (const vo::TrackedPoint& point : tracks.points) all.push_back(point.to.x_px);
  return all;
}

TEST(TrackingWindow, ComparesEachPointWithItselfWindowFramesAgo) {
  vo::TrackingWindow window(2);
  EXPECT_EQ(window.push(std::vector{at(10), at(20)}, {}).span, 0);
  // The two points change places in the list; a third appears.
  const vo::Tracks second =
      window.push(std::vector{at(21), at(11), at(31)}, std::vector<vo::Match>{{0, 1, 0}, {1, 0, 0}});
  EXPECT_EQ(second.span, 1);  // no frame two ago yet
  EXPECT_THAT(from_of(second), ElementsAre(20, 10));
  EXPECT_THAT(to_of(second), ElementsAre(21, 11));
  // All three are seen again; only the old ones were there two frames ago.
  const vo::Tracks third = window.push(std::vector{at(12), at(22), at(32)},
                                       std::vector<vo::Match>{{0, 1, 0}, {1, 0, 0}, {2, 2, 0}});
  EXPECT_EQ(third.span, 2);
  EXPECT_THAT(from_of(third), ElementsAre(10, 20));
  EXPECT_THAT(to_of(third), ElementsAre(12, 22));
  // The window moves on: the first frame is forgotten.
  const vo::Tracks fourth =
      window.push(std::vector{at(13), at(33)}, std::vector<vo::Match>{{0, 0, 0}, {2, 1, 0}});
  EXPECT_THAT(from_of(fourth), ElementsAre(11, 31));
}

TEST(TrackingWindow, LosesPointsThatMissAFrame) {
  vo::TrackingWindow window(2);
  window.push(std::vector{at(10)}, {});
  window.push(std::vector{at(11)}, {});  // seen, but not matched: another point
  const vo::Tracks third = window.push(std::vector{at(12)}, std::vector<vo::Match>{{0, 0, 0}});
  EXPECT_EQ(third.span, 2);
  EXPECT_THAT(third.points, testing::IsEmpty());
}

TEST(TrackingWindow, OfOneIsPlainMatching) {
  vo::TrackingWindow window(1);
  window.push(std::vector{at(10)}, {});
  for (float x = 11; x < 15; ++x) {
    const vo::Tracks tracks = window.push(std::vector{at(x)}, std::vector<vo::Match>{{0, 0, 0}});
    EXPECT_THAT(from_of(tracks), ElementsAre(x - 1));
  }
}

TEST(TrackingWindow, RefusesWhatItCannotTake) {
  EXPECT_THROW(vo::TrackingWindow(0), std::invalid_argument);
  EXPECT_THROW(vo::TrackingWindow(6), std::invalid_argument);
  vo::TrackingWindow window(3);
  window.push(std::vector{at(1)}, {});
  EXPECT_THROW(window.push(std::vector{at(1)}, std::vector<vo::Match>{{1, 0, 0}}), std::invalid_argument);
  EXPECT_THROW(window.push(std::vector{at(1)}, std::vector<vo::Match>{{0, 1, 0}}), std::invalid_argument);
}

}  // namespace
