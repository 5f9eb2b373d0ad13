#include "io/gpmf.hpp"

#include "support/gpmf_pieces.hpp"

#include <cstdint>
#include <span>
#include <string>

#include <gtest/gtest.h>

namespace {

using namespace test_support;

std::span<const std::uint8_t> bytes(const std::string& text) {
  return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

TEST(Gpmf, ReadsPositionsAmongOtherStreams) {
  const std::string piece = gps5_piece({{51.5, -0.25}, {-33.8567844, 151.2152967}});
  const auto positions = vo::gpmf_positions(bytes(piece));
  ASSERT_TRUE(positions);
  ASSERT_EQ(positions->size(), 2U);
  EXPECT_DOUBLE_EQ((*positions)[0].latitude_deg, 51.5);
  EXPECT_DOUBLE_EQ((*positions)[0].longitude_deg, -0.25);
  EXPECT_NEAR((*positions)[1].latitude_deg, -33.8567844, 1e-7);
  EXPECT_NEAR((*positions)[1].longitude_deg, 151.2152967, 1e-7);
  EXPECT_TRUE((*positions)[1].fix);
}

TEST(Gpmf, SaysWhereTheReceiverDidNotKnow) {
  const std::string piece = gps5_piece({{1, 2}}, 0);
  EXPECT_FALSE(vo::gpmf_positions(bytes(piece))->at(0).fix);
}

TEST(Gpmf, ReadsTheNewerFormWithAFixForEach) {
  std::string values;
  for (const int fix : {3, 0}) {
    values += big_endian(515000000, 4) + big_endian(-2500000, 4);
    for (int i = 0; i < 5; ++i) values += big_endian(7, 4);
    values += big_endian(150, 2) + big_endian(fix, 2);
  }
  std::string scales;
  for (const int scale : {10000000, 10000000, 1000, 1000, 100, 1, 1000, 100, 1})
    scales += big_endian(scale, 4);
  const std::string piece = gpmf_container(
      "DEVC",
      gpmf_container("STRM", gpmf_entry("SCAL", 'l', 4, scales) + gpmf_entry("GPS9", '?', 32, values)));
  const auto positions = vo::gpmf_positions(bytes(piece));
  ASSERT_TRUE(positions);
  ASSERT_EQ(positions->size(), 2U);
  EXPECT_DOUBLE_EQ((*positions)[0].latitude_deg, 51.5);
  EXPECT_DOUBLE_EQ((*positions)[0].longitude_deg, -0.25);
  EXPECT_TRUE((*positions)[0].fix);
  EXPECT_FALSE((*positions)[1].fix);
}

TEST(Gpmf, OneScaleMayBeForAll) {
  const std::string values = big_endian(200, 4) + big_endian(300, 4) + std::string(12, '\0');
  const std::string piece =
      gpmf_entry("SCAL", 's', 2, big_endian(100, 2)) + gpmf_entry("GPS5", 'l', 20, values);
  const auto positions = vo::gpmf_positions(bytes(piece));
  ASSERT_EQ(positions->size(), 1U);
  EXPECT_DOUBLE_EQ(positions->at(0).latitude_deg, 2);
  EXPECT_DOUBLE_EQ(positions->at(0).longitude_deg, 3);
}

TEST(Gpmf, ReadsAccelerations) {
  const auto read = vo::gpmf_accelerations(bytes(accl_piece({{0.5, -9.75, 2}, {0, 0, -1.25}})));
  ASSERT_TRUE(read);
  ASSERT_EQ(read->size(), 2U);
  EXPECT_NEAR((*read)[0][1], -9.75, 1 / 418.);
  EXPECT_NEAR((*read)[0][2], 2, 1 / 418.);
  EXPECT_NEAR((*read)[1][2], -1.25, 1 / 418.);
  EXPECT_TRUE(vo::gpmf_accelerations(bytes(gps5_piece({})))->size() == 3) << "the stream of something else";
  const std::string values(12, '\1');
  EXPECT_FALSE(vo::gpmf_accelerations(bytes(gpmf_entry("ACCL", 's', 6, values)))) << "no scale";
  EXPECT_FALSE(vo::gpmf_accelerations(
      bytes(gpmf_entry("SCAL", 's', 2, big_endian(0, 2)) + gpmf_entry("ACCL", 's', 6, values))));
  EXPECT_FALSE(vo::gpmf_accelerations(
      bytes(gpmf_entry("SCAL", 's', 2, big_endian(1, 2)) + gpmf_entry("ACCL", 's', 4, values))));
}

TEST(Gpmf, NothingAndPaddingHoldNone) {
  EXPECT_TRUE(vo::gpmf_positions({})->empty());
  EXPECT_TRUE(vo::gpmf_positions(bytes(std::string(16, '\0')))->empty());
  EXPECT_TRUE(vo::gpmf_positions(bytes(gpmf_entry("TICK", 'L', 4, big_endian(5, 4))))->empty());
}

TEST(Gpmf, RefusesWhatIsDamaged) {
  const std::string piece = gps5_piece({{51.5, -0.25}, {51.6, -0.25}});
  EXPECT_FALSE(vo::gpmf_positions(bytes(piece.substr(0, piece.size() - 4))));  // shorter than it says
  const std::string values(20, '\1');
  EXPECT_FALSE(vo::gpmf_positions(bytes(gpmf_entry("GPS5", 'l', 20, values))));  // no scale
  EXPECT_FALSE(vo::gpmf_positions(
      bytes(gpmf_entry("SCAL", 'l', 4, big_endian(0, 4)) + gpmf_entry("GPS5", 'l', 20, values))));
  EXPECT_FALSE(vo::gpmf_positions(
      bytes(gpmf_entry("SCAL", 'l', 4, big_endian(1, 4)) + gpmf_entry("GPS5", 'l', 10, values))));
}

TEST(Gpmf, AnyDamageIsRefusedOrHarmless) {
  const std::string whole = gps5_piece({{51.5, -0.25}, {51.6, -0.25}});
  for (std::size_t at = 0; at < whole.size(); ++at) {
    for (const char value : {'\0', '\x7F', '\xFF'}) {
      std::string piece = whole;
      piece[at] = value;
      const auto positions = vo::gpmf_positions(bytes(piece));  // the sanitizers watch
      EXPECT_LE(positions ? positions->size() : 0, piece.size() / 20);
    }
  }
}

}  // namespace
