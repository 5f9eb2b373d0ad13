#pragma once

#include "support/random_images.hpp"

#include <cstdint>
#include <string>
#include <variant>

#include <gtest/gtest.h>

#include <place/describe/quantise.hpp>
#include <place/route/route.hpp>

namespace test_support {

/// A traverse whose keyframes lack now distances, now poses, now previews.
inline place::Traverse example_traverse(const std::string& name, std::size_t keyframes, std::uint64_t seed) {
  place::Traverse traverse;
  traverse.name = name;
  traverse.source = name + "'s \"walk\" ü.mp4";
  traverse.frames = 12345;
  traverse.duration_s = 411.4666666666667;
  traverse.frame_width_px = 1920;
  traverse.frame_height_px = 1080;
  traverse.pose_source = "poses.tum";
  traverse.settings.fov_deg = 64.4;
  traverse.settings.max_speed = 1.0 / 3;
  traverse.settings.tie_scale = false;
  traverse.settings.motion = "none";
  for (std::size_t i = 0; i < keyframes; ++i) {
    place::Keyframe keyframe;
    keyframe.frame = static_cast<std::int64_t>(7 * i);
    keyframe.time_s = static_cast<double>(i) / 3;
    keyframe.displacement = 0.1 * static_cast<double>(i);
    if (i % 2 == 0) keyframe.distance_m = -1.0 / 7 + static_cast<double>(i);
    if (i % 3 == 0) keyframe.pose = vo::Pose2{1e-9, -0.0, -3.1};
    keyframe.after_gap = i % 5 == 3;
    if (i % 4 == 0) keyframe.preview_jpeg = {0, 255, static_cast<std::uint8_t>(i)};
    traverse.keyframes.push_back(keyframe);
  }
  traverse.thumbnails = random_images(16, 8, keyframes, seed);
  place::ColumnStack columns = place::make_column_stack(2, 5, keyframes);
  for (std::size_t i = 0; i < columns.values.size(); ++i)
    columns.values[i] = static_cast<std::int8_t>(static_cast<int>(i * seed % 255) - 127);
  place::FloatRows rows = place::make_float_rows(3, keyframes);
  for (std::size_t i = 0; i < rows.values.size(); ++i) rows.values[i] = -1.5F * static_cast<float>(i);
  traverse.descriptors = {columns, rows, random_images(8, 4, keyframes, seed + 1)};
  return traverse;
}

inline place::Route example_route() {
  place::Route route;
  route.settings.thumbnail_width = 16;
  route.settings.patch_min_contrast = 0.7;
  route.settings.motion = "none";
  route.settings.every = 3;
  route.unit = 0.1;
  route.metric = true;
  route.traverses.push_back(example_traverse("by day", 600, 1));    // three chunks, the last one not full
  route.traverses.push_back(example_traverse("by night", 256, 2));  // one full chunk
  route.traverses.push_back(example_traverse("", 0, 3));            // no keyframe
  route.traverses.push_back(example_traverse("short", 1, 4));
  route.traverses[1].surveyed = false;
  route.traverses[1].places = {{"gate", 3, {}}, {"caf\xC3\xA9 \"<b>\"", 90, 12.25}};
  route.learned = {{1, 2, 250}, {}, {7}};
  route.origin = {.latitude_deg = -33.85678, .longitude_deg = 151.21528};
  return route;
}

inline void expect_equal(const place::Traverse& a, const place::Traverse& b) {
  EXPECT_EQ(a.name, b.name);
  EXPECT_EQ(a.source, b.source);
  EXPECT_EQ(a.frames, b.frames);
  EXPECT_EQ(a.duration_s, b.duration_s);
  EXPECT_EQ(a.frame_width_px, b.frame_width_px);
  EXPECT_EQ(a.frame_height_px, b.frame_height_px);
  EXPECT_EQ(a.pose_source, b.pose_source);
  EXPECT_EQ(a.surveyed, b.surveyed);
  EXPECT_EQ(a.settings, b.settings);
  EXPECT_EQ(a.thumbnails.width, b.thumbnails.width);
  EXPECT_EQ(a.thumbnails.height, b.thumbnails.height);
  EXPECT_EQ(a.thumbnails.pixels, b.thumbnails.pixels);
  ASSERT_EQ(a.descriptors.size(), 3U);
  ASSERT_EQ(b.descriptors.size(), 3U);
  const auto &columns = std::get<place::ColumnStack>(a.descriptors[0]),
             &others = std::get<place::ColumnStack>(b.descriptors[0]);
  EXPECT_EQ(columns.columns, others.columns);
  EXPECT_EQ(columns.channels, others.channels);
  EXPECT_EQ(columns.values, others.values);
  EXPECT_EQ(std::get<place::FloatRows>(a.descriptors[1]).values,
            std::get<place::FloatRows>(b.descriptors[1]).values);
  EXPECT_EQ(std::get<vo::ImageStack>(a.descriptors[2]).pixels,
            std::get<vo::ImageStack>(b.descriptors[2]).pixels);
  EXPECT_EQ(a.view_points, b.view_points);
  ASSERT_EQ(a.places.size(), b.places.size());
  for (std::size_t i = 0; i < a.places.size(); ++i) {
    EXPECT_EQ(a.places[i].name, b.places[i].name);
    EXPECT_EQ(a.places[i].frame, b.places[i].frame);
    EXPECT_EQ(a.places[i].distance_m, b.places[i].distance_m);
  }
  ASSERT_EQ(a.keyframes.size(), b.keyframes.size());
  for (std::size_t i = 0; i < a.keyframes.size(); ++i) {
    const place::Keyframe &j = a.keyframes[i], &k = b.keyframes[i];
    EXPECT_EQ(j.frame, k.frame);
    EXPECT_EQ(j.time_s, k.time_s);
    EXPECT_EQ(j.displacement, k.displacement);
    EXPECT_EQ(j.distance_m, k.distance_m);
    EXPECT_EQ(j.after_gap, k.after_gap);
    EXPECT_EQ(j.preview_jpeg, k.preview_jpeg);
    ASSERT_EQ(j.pose.has_value(), k.pose.has_value());
    if (!j.pose) continue;
    EXPECT_EQ(j.pose->x_m, k.pose->x_m);
    EXPECT_EQ(j.pose->y_m, k.pose->y_m);
    EXPECT_EQ(j.pose->heading_rad, k.pose->heading_rad);
  }
}

inline void expect_equal(const place::Route& a, const place::Route& b) {
  EXPECT_EQ(a.settings, b.settings);
  EXPECT_EQ(a.learned, b.learned);
  EXPECT_EQ(a.unit, b.unit);
  EXPECT_EQ(a.metric, b.metric);
  ASSERT_EQ(a.origin.has_value(), b.origin.has_value());
  if (a.origin) {
    EXPECT_EQ(a.origin->latitude_deg, b.origin->latitude_deg);
    EXPECT_EQ(a.origin->longitude_deg, b.origin->longitude_deg);
  }
  ASSERT_EQ(a.traverses.size(), b.traverses.size());
  for (std::size_t i = 0; i < a.traverses.size(); ++i) {
    SCOPED_TRACE(i);
    expect_equal(a.traverses[i], b.traverses[i]);
  }
}

}  // namespace test_support
