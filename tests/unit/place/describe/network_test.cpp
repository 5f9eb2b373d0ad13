#include "place/describe/network.hpp"

#include "support/temporary_folder.hpp"

#include <cstring>
#include <stdexcept>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include <vo/base/error.hpp>

namespace {

using place::ColumnStack;
using place::KeyframeRecords;
using place::NetworkOptions;
using place::pool_grid;
using testing::ElementsAre;

TEST(PoolGrid, AveragesEqualParts) {
  // One channel of 2 x 4.
  const std::vector<float> grid{1, 3, 5, 7, 2, 4, 6, 8};
  EXPECT_THAT(pool_grid(grid, 1, 2, 4, 1, 2), ElementsAre(2.5, 6.5));
  EXPECT_THAT(pool_grid(grid, 1, 2, 4, 2, 1), ElementsAre(4, 5));
  EXPECT_THAT(pool_grid(grid, 1, 2, 4, 2, 4), ElementsAre(1, 2, 3, 4, 5, 6, 7, 8));  // column after column
}

TEST(PoolGrid, SharesWhatLiesOnABorder) {
  // Three cells over two parts: the middle one counts half for each; and over six: each twice.
  const std::vector<float> grid{3, 6, 12};
  EXPECT_THAT(pool_grid(grid, 1, 1, 3, 1, 2), ElementsAre(testing::FloatEq(4), testing::FloatEq(10)));
  EXPECT_THAT(pool_grid(grid, 1, 1, 3, 1, 6), testing::Pointwise(testing::FloatEq(), {3, 3, 6, 6, 12, 12}));
}

TEST(PoolGrid, KeepsChannelsTogether) {
  EXPECT_THAT(pool_grid(std::vector<float>{1, 2, 30, 40}, 2, 1, 2, 1, 2), ElementsAre(1, 30, 2, 40));
  EXPECT_THROW(pool_grid(std::vector<float>(3), 2, 1, 2, 1, 2), std::invalid_argument);
}

/// A Darknet model of one convolution that gives red and green as they are, 16 x 16.
class TinyNetwork : public testing::Test {
 protected:
  TinyNetwork() {
    folder_.write("tiny.cfg",
                  "[net]\nwidth=16\nheight=16\nchannels=3\n\n[convolutional]\nfilters=2\nsize=1\nstride=1\n"
                  "pad=0\nactivation=linear\n");
    std::string weights(20, '\0');  // version 0.2.0 and 8 bytes of pictures seen
    weights[4] = 2;
    const std::vector<float> numbers{0, 0, 1, 0, 0, 0, 1, 0};  // two biases, then two filters over r, g, b
    weights.append(reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(float));
    folder_.write("tiny.weights", weights);
    options_ = {.model = (folder_ / "tiny.weights").string(),
                .model_config = (folder_ / "tiny.cfg").string(),
                .layer = "conv_0",
                .input_width = 16,
                .input_height = 16,
                .pool_rows = 2,
                .pool_columns = 4};
  }
  [[nodiscard]] std::unique_ptr<place::Descriptor> make() const {
    return place::make_network({.network = options_});
  }

  /// Two pictures, grey but for a bright red and a bright green right half.
  [[nodiscard]] KeyframeRecords keyframes() const {
    KeyframeRecords keyframes{.frames = {0, 1}, .time_s = {0, 1}};
    for (const cv::Scalar& colour : {cv::Scalar(0, 0, 255), cv::Scalar(0, 255, 0)}) {
      vo::Frame frame;
      frame.image = cv::Mat(64, 64, CV_8UC3, cv::Scalar(100, 100, 100));
      frame.image.colRange(32, 64).setTo(colour);
      keyframes.records.push_back(make()->record(frame));
    }
    return keyframes;
  }

  test_support::TemporaryFolder folder_;
  NetworkOptions options_;
};

TEST_F(TinyNetwork, DescribesByItsLayer) {
  const auto descriptor = make();
  const KeyframeRecords walk = keyframes();
  const auto stack = std::get<ColumnStack>(descriptor->describe(walk, descriptor->learn(walk)));
  ASSERT_EQ(stack.size(), 2U);
  EXPECT_EQ(stack.columns, 4);
  EXPECT_EQ(stack.channels, 2 * 2);
  // Left half alike, so next to nothing; in the right half red is high where green is low.
  for (const std::size_t column : {2U, 3U}) {
    EXPECT_GT(stack[0][column * 4], 5);
    EXPECT_LT(stack[0][column * 4 + 1], -5);
    EXPECT_LT(stack[1][column * 4], -5);
    EXPECT_GT(stack[1][column * 4 + 1], 5);
  }
  EXPECT_EQ(count_of(descriptor->describe({}, descriptor->learn(walk))), 0U);
}

TEST_F(TinyNetwork, SaysWhatToDo) {
  const auto refused = [&](const char* why) {
    EXPECT_THROW_WITH(make()->learn(keyframes()), vo::Error, why);
  };
  const NetworkOptions good = options_;
  options_.layer = "conv";
  refused("layer: 'conv' is none of the");
  refused("conv_0");
  options_ = good;
  options_.model = "";
  refused("model: is missing");
  options_.model = (folder_ / "none.onnx").string();
  refused("is no file");
  options_.model = folder_.write("broken.onnx", "nothing").string();
  refused("is not understood by OpenCV");
  options_.model = folder_.write("model.pt", "nothing").string();
  refused("ends in '.pt'");
  options_ = good;
  options_.model_config = "";
  refused("model-config: is missing");
}

TEST_F(TinyNetwork, RefusesARecordThatIsNoPicture) {
  KeyframeRecords walk = keyframes();
  walk.records[1] = place::Bytes(4);
  EXPECT_THROW(static_cast<void>(make()->learn(walk)), vo::Error);
}

TEST(PoolGrid, CoversEachPartWhole) {
  for (const auto& [cells, parts] :
       {std::pair(30, 22), std::pair(164, 20), std::pair(328, 20), std::pair(7, 11)})
    for (const float value :
         pool_grid(std::vector<float>(static_cast<std::size_t>(cells), 1.0F), 1, 1, cells, 1, parts))
      EXPECT_NEAR(value, 1, 1e-6) << cells << " in " << parts;
}

}  // namespace
