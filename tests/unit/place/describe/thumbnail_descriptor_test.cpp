#include "place/describe/thumbnail_descriptor.hpp"

#include "support/described_views.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vo/image/patch_normalisation.hpp>

namespace {

using test_support::keyframes_of;

TEST(ThumbnailDescriptor, IsThePatchNormalisedThumbnail) {
  const vo::PatchNormalisationOptions patch{.patch_px = 4};
  const auto descriptor = place::make_thumbnail({.patch = patch});
  const place::KeyframeRecords keyframes = keyframes_of(*descriptor, 2, {});
  EXPECT_TRUE(descriptor->learn(keyframes).empty());
  const place::Descriptors described = descriptor->describe(keyframes, {});
  EXPECT_EQ(std::get<vo::ImageStack>(described).pixels, keyframes.thumbnails.pixels);
  EXPECT_EQ(std::get<vo::ImageStack>(descriptor->comparable(described)).pixels,
            vo::patch_normalise(keyframes.thumbnails, patch).pixels);
}

TEST(ThumbnailDescriptor, AsksForNothingOfFrames) {
  const auto descriptor = place::make_thumbnail({});
  EXPECT_FALSE(descriptor->traits().records_frames);
  EXPECT_EQ(count_of(descriptor->describe({}, {})), 0U);
}

}  // namespace
