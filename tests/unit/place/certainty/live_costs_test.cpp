#include "certainty/live_costs.hpp"

#include "support/known_walk.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include <place/resolve.hpp>
#include <vo/base/error.hpp>

namespace {

using namespace test_support;

class LiveCostsTest : public testing::Test {
 protected:
  LiveCostsTest() {
    route_.settings.descriptor = "thumbnail";
    add_traverse(route_, "day", day_);
    options_ =
        place::stage_options(place::resolve({}, {.route = &route_.settings, .drop_ineffective = true}));
  }
  [[nodiscard]] vo::ImageStack picture(double place_px) const { return wall_.walk({{place_px}}).thumbnails; }

  Wall wall_{kWallPx, 1};
  KnownWalk day_ = steady_walk(wall_, 0.5);
  place::Route route_;
  place::StageOptions options_;
};

TEST_F(LiveCostsTest, AreLeastAtThePlaceOfThePicture) {
  place::LiveCosts costs(route_, options_);
  for (const double place_px : {30.0, 200.0, 410.0}) {
    const std::vector<float> row = costs.against({}, picture(place_px));
    ASSERT_EQ(row.size(), route_.traverses[0].keyframes.size());
    const auto best = static_cast<std::size_t>(std::ranges::min_element(row) - row.begin());
    EXPECT_NEAR(*route_.traverses[0].keyframes[best].distance_m * 10, place_px,
                spacing_px(route_.traverses[0]));
    EXPECT_LT(row[best], -2);  // deviations: one place of many
  }
}

TEST_F(LiveCostsTest, TakeOffWhatAKeyframeUsuallyCosts) {
  // The same picture over and over is what every keyframe usually costs: nothing stands out any more.
  place::LiveCosts costs(route_, options_);
  const vo::ImageStack same = picture(200);
  const std::vector<float> first = costs.against({}, same);
  std::vector<float> last;
  for (int i = 0; i < 500; ++i) last = costs.against({}, same);
  EXPECT_GT(*std::ranges::min_element(last), *std::ranges::min_element(first) / 2);
}

TEST_F(LiveCostsTest, HaveAllTraverses) {
  add_traverse(route_, "again", steady_walk(wall_, 0.7));
  place::LiveCosts costs(route_, options_);
  EXPECT_EQ(costs.against({}, picture(100)).size(),
            route_.traverses[0].keyframes.size() + route_.traverses[1].keyframes.size());
}

TEST_F(LiveCostsTest, RefuseARouteDescribedByAFile) {
  route_.settings.descriptor = "file";
  EXPECT_THROW(place::LiveCosts(route_, options_), vo::Error);
}

}  // namespace
