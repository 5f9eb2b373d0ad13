#include "simulate/options.hpp"

#include <cmath>
#include <functional>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vo/base/error.hpp>

namespace simulate {
namespace {

TEST(SimulateOptions, DefaultsAreValid) {
  EXPECT_NO_THROW(validate({}));
}

TEST(SimulateOptions, NamesFieldValueAndRange) {
  try {
    validate({.length_m = -3});
    FAIL();
  } catch (const vo::Error& error) {
    EXPECT_STREQ(error.what(), "length-m: is -3; expected a number from 5 to 5000 m");
  }
}

TEST(SimulateOptions, RefusesEveryFieldOutOfRange) {
  const std::pair<const char*, std::function<void(Options&)>> broken[] = {
      {"length-m", [](Options& o) { o.length_m = std::nan(""); }},
      {"lateral-m", [](Options& o) { o.lateral_m = 5; }},
      {"lateral-m", [](Options& o) { o.scene = Scene::kCorridor, o.lateral_m = -1; }},
      {"camera-yaw-deg", [](Options& o) { o.camera_yaw_deg = 120; }},
      {"camera-pitch-deg", [](Options& o) { o.camera_pitch_deg = -60; }},
      {"people", [](Options& o) { o.people = -1; }},
      {"detour-m", [](Options& o) { o.detour_m = 100; }},
      {"start-m", [](Options& o) { o.start_m = 120; }},
      {"swing", [](Options& o) { o.swing = -1; }},
      {"size", [](Options& o) { o.size = {}; }},
      {"frame-rate-hz", [](Options& o) { o.frame_rate_hz = 0; }},
      {"fov-deg", [](Options& o) { o.fov_deg = 180; }},
  };
  for (const auto& [field, breaks] : broken) {
    Options options;
    breaks(options);
    EXPECT_THAT([&] { validate(options); },
                testing::ThrowsMessage<vo::Error>(testing::StartsWith(std::string(field) + ": is ")));
  }
}

}  // namespace
}  // namespace simulate
