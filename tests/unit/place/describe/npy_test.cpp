#include "place/describe/npy.hpp"

#include "support/temporary_folder.hpp"

#include <stdexcept>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vo/base/error.hpp>

namespace {

using place::FloatRows;
using place::read_npy;
using place::write_npy;
using testing::ElementsAre;

/// A file as NumPy writes it: the header filled up with spaces to a multiple of 64 bytes.
std::string npy(const std::string& dictionary, const std::string& data) {
  std::string header = dictionary;
  header.append(63 - (10 + header.size()) % 64, ' ');
  header += '\n';
  return std::string("\x93NUMPY\x01", 7) + '\0' + static_cast<char>(header.size()) + '\0' + header + data;
}

class Npy : public testing::Test {
 protected:
  test_support::TemporaryFolder folder_;
};

TEST_F(Npy, ReadsBytes) {
  const auto path = folder_.write("a.npy", npy("{'descr': '|u1', 'fortran_order': False, 'shape': (2, 3), }",
                                               std::string("\x01\x02\x03\xff\x00\x05", 6)));
  const FloatRows rows = read_npy(path);
  EXPECT_EQ(rows.width, 3U);
  EXPECT_THAT(rows.values, ElementsAre(1, 2, 3, 255, 0, 5));
}

TEST_F(Npy, ReadsHalves) {
  // 0x3c00 is 1, 0xc000 is -2, 0x3800 is 0.5.
  const auto path = folder_.write("a.npy", npy("{'descr': '<f2', 'fortran_order': False, 'shape': (1, 3), }",
                                               std::string("\x00\x3c\x00\xc0\x00\x38", 6)));
  EXPECT_THAT(read_npy(path).values, ElementsAre(1, -2, 0.5));
}

TEST_F(Npy, ReadsWhatItWrites) {
  const FloatRows rows{.width = 2, .values = {1.5F, -3e8F, 0, 7}};
  write_npy(folder_ / "f.npy", rows);
  EXPECT_EQ(read_npy(folder_ / "f.npy").values, rows.values);
  write_npy(folder_ / "b.npy", std::vector<std::uint8_t>{9, 8, 7, 6}, 4);
  EXPECT_THAT(read_npy(folder_ / "b.npy").values, ElementsAre(9, 8, 7, 6));
  EXPECT_EQ(test_support::read_file(folder_ / "b.npy").size(), 128U + 4U);  // the header is padded
  write_npy(folder_ / "i.npy", std::vector<std::int8_t>{-128, -1, 0, 127}, 2);
  EXPECT_THAT(read_npy(folder_ / "i.npy").values, ElementsAre(-128, -1, 0, 127));
}

TEST_F(Npy, WritesDescriptorsOfEveryKind) {
  const place::Descriptors images = vo::ImageStack{.width = 2, .height = 1, .pixels = {1, 2, 3, 255}};
  EXPECT_EQ(write_npy(folder_ / "i.npy", images), 2U);
  EXPECT_THAT(read_npy(folder_ / "i.npy").values, ElementsAre(1, 2, 3, 255));
  EXPECT_NE(test_support::read_file(folder_ / "i.npy").find("|u1"), std::string::npos);
  const place::Descriptors columns =
      place::ColumnStack{.columns = 1, .channels = 3, .values = {-128, 0, 127}};
  EXPECT_EQ(write_npy(folder_ / "c.npy", columns), 3U);
  EXPECT_THAT(read_npy(folder_ / "c.npy").values, ElementsAre(-128, 0, 127));
  EXPECT_NE(test_support::read_file(folder_ / "c.npy").find("<f4"), std::string::npos);
  const place::Descriptors floats = FloatRows{.width = 1, .values = {0.5F, 1}};
  EXPECT_EQ(write_npy(folder_ / "f.npy", floats), 1U);
  EXPECT_THAT(read_npy(folder_ / "f.npy").values, ElementsAre(0.5, 1));
}

TEST_F(Npy, NoRowsAreNone) {
  write_npy(folder_ / "e.npy", FloatRows{.width = 5, .values = {}});
  EXPECT_EQ(read_npy(folder_ / "e.npy").size(), 0U);
  EXPECT_THROW(write_npy(folder_ / "e.npy", std::vector<std::uint8_t>(5), 3), std::invalid_argument);
}

TEST_F(Npy, SaysWhatIsWrong) {
  const auto refused = [&](const std::string& content, const char* why) {
    const auto path = folder_.write("bad.npy", content);
    EXPECT_THROW_WITH(read_npy(path), vo::Error, why);
  };
  EXPECT_THROW_WITH(read_npy(folder_ / "none.npy"), vo::Error, "cannot be read");
  refused("frame,time_s", "is no .npy file");
  refused(npy("{'descr': '<f8', 'fortran_order': False, 'shape': (1, 1), }", std::string(8, '\0')),
          "type '<f8'");
  refused(npy("{'descr': '<f4', 'fortran_order': True, 'shape': (1, 1), }", std::string(4, '\0')), "Fortran");
  refused(npy("{'descr': '<f4', 'fortran_order': False, 'shape': (4,), }", std::string(16, '\0')),
          "two dimensions");
  const std::string infinite("\0\0\x80\x3f\0\0\x80\x7f", 8);  // 1 and infinity, as float32
  refused(npy("{'descr': '<f4', 'fortran_order': False, 'shape': (1, 2), }", infinite),
          "inf in row 0, column 1");
  refused(npy("{'descr': '<f4', 'fortran_order': False, 'shape': (2, 2), }", std::string(15, '\0')),
          "15 bytes");
  refused(npy("{'descr': '<f4', 'fortran_order': False, 'shape': (2, 0), }", ""), "0 bytes");
  // A number more than the rows have, and none of rows that are there: neither is room for it.
  refused(npy("{'descr': '<f4', 'fortran_order': False, 'shape': (1, 3), }", std::string(16, '\0')),
          "holds 16 bytes where 1 x 3 numbers should be");
  refused(npy("{'descr': '<f4', 'fortran_order': False, 'shape': (0, 3), }", std::string(8, '\0')),
          "holds 8 bytes where 0 x 3 numbers should be");
  refused(npy("{'descr': '|u1', 'fortran_order': False, 'shape': (4294967296, 4294967296), }", ""),
          "holds 0 bytes");
}

}  // namespace
