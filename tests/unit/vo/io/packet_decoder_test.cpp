#include "io/packet_decoder.hpp"

#include "support/temporary_folder.hpp"
#include "support/video_writer.hpp"

#include <cstdint>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vo/base/error.hpp>

namespace {

using test_support::TemporaryFolder;

/// Everything a decoder gave out of a file.
struct Decoded {
  std::vector<std::vector<std::uint8_t>> luma;
  std::int64_t damaged = 0;
  std::optional<double> first_damaged_s;

  bool operator==(const Decoded&) const = default;
};

Decoded decode(const std::filesystem::path& path, int threads) {
  vo::PacketDecoder decoder(path.string(), threads);
  Decoded all;
  while (const AVFrame* frame = decoder.next()) {
    std::vector<std::uint8_t>& luma = all.luma.emplace_back();
    for (int y = 0; y < frame->height; ++y) {
      const std::uint8_t* line = frame->data[0] + static_cast<std::ptrdiff_t>(y) * frame->linesize[0];
      luma.insert(luma.end(), line, line + frame->width);
    }
  }
  EXPECT_TRUE(decoder.report().ended);
  all.damaged = decoder.report().damaged;
  all.first_damaged_s = decoder.report().first_damaged_s;
  return all;
}

TEST(PacketDecoder, AWholeFileIsTheSameForAnyNumberOfThreads) {
  const TemporaryFolder folder;
  test_support::write_moving_noise(folder / "walk.mp4");
  const Decoded serial = decode(folder / "walk.mp4", 1);
  EXPECT_EQ(serial.luma.size(), 70U);
  EXPECT_EQ(serial.damaged, 0);
  EXPECT_FALSE(serial.first_damaged_s);
  EXPECT_EQ(decode(folder / "walk.mp4", 4), serial);
}

TEST(PacketDecoder, ADamagedFileIsTheSameForAnyNumberOfThreads) {
  const TemporaryFolder folder;
  test_support::write_moving_noise(folder / "walk.mp4");
  const std::string whole = test_support::read_file(folder / "walk.mp4");
  for (const std::uint64_t seed : {1, 2, 3}) {
    const auto path = folder.write("damaged.mp4", test_support::damaged(whole, seed));
    const Decoded serial = decode(path, 1);
    EXPECT_GT(serial.damaged, 0) << seed;
    EXPECT_TRUE(serial.first_damaged_s) << seed;
    for (const int threads : {2, 3, 4}) EXPECT_EQ(decode(path, threads), serial) << seed << ' ' << threads;
  }
}

TEST(PacketDecoder, GoesToATime) {
  const TemporaryFolder folder;
  test_support::write_moving_noise(folder / "walk.mp4");
  vo::PacketDecoder decoder((folder / "walk.mp4").string(), 1);
  ASSERT_TRUE(decoder.seek(1.7));
  const AVFrame* frame = decoder.next();
  ASSERT_NE(frame, nullptr);
  EXPECT_NEAR(decoder.seconds(frame->best_effort_timestamp), 1.6, 1e-3);  // the key frame before: every 0.8 s
}

TEST(PacketDecoder, RefusesWhatIsNoVideo) {
  const TemporaryFolder folder;
  EXPECT_THROW_WITH(vo::PacketDecoder(folder.write("text.mp4", "this is text\n").string()), vo::Error,
                    "text.mp4: is no video that FFmpeg can read");
}

}  // namespace
