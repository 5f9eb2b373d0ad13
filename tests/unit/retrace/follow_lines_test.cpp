#include "follow_lines.hpp"

#include <numbers>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <place/certainty/follower.hpp>

namespace {

std::string line_of_heading(double heading_rad) {
  place::Position position;
  position.place.emplace().pose = vo::Pose2{0, 0, heading_rad};
  return retrace::follow_line(position);
}

TEST(FollowLine, HasHeadingsFromZeroToBelow360) {
  using testing::HasSubstr;
  EXPECT_THAT(line_of_heading(std::numbers::pi / 2), HasSubstr("\"heading_deg\":90.0"));
  EXPECT_THAT(line_of_heading(-std::numbers::pi / 6), HasSubstr("\"heading_deg\":330.0"));
  EXPECT_THAT(line_of_heading(0), HasSubstr("\"heading_deg\":0.0"));
  EXPECT_THAT(line_of_heading(-3e-5), HasSubstr("\"heading_deg\":0.0"));  // a hair to the left of north
}

}  // namespace
