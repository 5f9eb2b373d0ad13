#include "support/shared_data.hpp"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <place/match/openseqslam.hpp>

namespace {

namespace fs = std::filesystem;

/// Runs our reproduction on the inputs the original ran on, stage by stage.
class OpenSeqSlamGolden : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    const auto golden = test_support::golden_folder();
    if (!golden) GTEST_SKIP() << "no golden outputs: set RETRACE_DATA to the data folder beside golden/";
    folder_ = *golden / "openseqslam" / GetParam();
    options_.quirks = place::openseqslam::Quirks::original();
  }

  [[nodiscard]] vo::ImageStack images(const std::string& name) const {
    vo::ImageStack stack = vo::make_image_stack(64, 32, 300);
    std::ifstream file(folder_ / name, std::ios::binary);
    file.read(reinterpret_cast<char*>(stack.pixels.data()),
              static_cast<std::streamsize>(stack.pixels.size()));
    EXPECT_EQ(file.gcount(), static_cast<std::streamsize>(stack.pixels.size())) << name;
    return stack;
  }

  /// Cells of a CSV, row-major; "NaN" is read as such.
  [[nodiscard]] std::vector<std::vector<double>> table(const std::string& name) const {
    std::ifstream file(folder_ / name);
    std::vector<std::vector<double>> rows;
    for (std::string line; std::getline(file, line);) {
      std::istringstream cells(line);
      rows.emplace_back();
      for (std::string cell; std::getline(cells, cell, ',');) rows.back().push_back(std::stod(cell));
    }
    EXPECT_EQ(rows.size(), 300U) << name;
    return rows;
  }

  /// Every value equal as a float: nine digits tell floats apart.
  static void expect_equal(const place::CostMatrix& ours, const std::vector<std::vector<double>>& golden) {
    std::size_t different = 0;
    for (std::size_t r = 0; r < golden.size(); ++r) {
      for (std::size_t q = 0; q < golden[r].size(); ++q) {
        const auto expected = static_cast<float>(golden[r][q]);
        const float value = ours.at(q, r);
        if (!(value == expected || (std::isnan(value) && std::isnan(expected)))) ++different;
      }
    }
    EXPECT_EQ(different, 0U);
  }

  fs::path folder_;
  place::openseqslam::Options options_;
};

TEST_P(OpenSeqSlamGolden, PatchNormalisation) {
  EXPECT_EQ(patch_normalise(images("grey_ref_u8_300x32x64.bin"), options_).pixels,
            images("P_ref_u8.bin").pixels);
  EXPECT_EQ(patch_normalise(images("grey_qry_u8_300x32x64.bin"), options_).pixels,
            images("P_qry_u8.bin").pixels);
}

TEST_P(OpenSeqSlamGolden, DifferenceAndEnhancedMatrix) {
  const place::CostMatrix differences =
      difference_matrix(images("P_qry_u8.bin"), images("P_ref_u8.bin"), options_);
  expect_equal(differences, table("D.csv"));
  expect_equal(enhance(differences, options_), table("DD.csv"));
}

TEST_P(OpenSeqSlamGolden, Matches) {
  const place::CostMatrix enhanced =
      enhance(difference_matrix(images("P_qry_u8.bin"), images("P_ref_u8.bin"), options_), options_);
  for (const int length : {10, 20, 50}) {
    SCOPED_TRACE(length);
    options_.sequence_length = length;
    const auto matches = find_matches(enhanced, options_);
    const auto golden = table("matches_ds" + std::to_string(length) + ".csv");
    ASSERT_EQ(matches.size(), golden.size());
    for (std::size_t q = 0; q < golden.size(); ++q) {
      SCOPED_TRACE(q);
      ASSERT_EQ(matches[q].reference.has_value(), !std::isnan(golden[q][1]));
      if (!matches[q].reference) continue;
      EXPECT_EQ(static_cast<double>(*matches[q].reference) + 1, golden[q][1]);
      // Sums of up to 51 floats: a few units in the last place of a score below 1.
      EXPECT_NEAR(matches[q].score, golden[q][2], 1e-6);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Nordland, OpenSeqSlamGolden, testing::Values("nord_301_600", "nord_1_300_edge"));

}  // namespace
