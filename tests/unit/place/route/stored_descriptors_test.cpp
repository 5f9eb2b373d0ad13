#include "place/route/stored_descriptors.hpp"

#include "route/sqlite.hpp"
#include "support/example_route.hpp"
#include "support/temporary_folder.hpp"

#include <numeric>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <place/route/route_database.hpp>
#include <vo/base/error.hpp>

namespace {

using place::Descriptors;
using place::StoredDescriptors;
using test_support::TemporaryFolder;

class StoredDescriptorsTest : public testing::Test {
 protected:
  StoredDescriptorsTest() : path_(folder_ / "route.db"), route_(test_support::example_route()) {
    place::write_route(path_, route_);
  }

  TemporaryFolder folder_;
  std::filesystem::path path_;
  place::Route route_;
};

/// The values of descriptors, whatever their form.
std::vector<double> values_of(const Descriptors& descriptors) {
  return std::visit(
      [](const auto& rows) {
        if constexpr (requires { rows.pixels; }) {
          return std::vector<double>(rows.pixels.begin(), rows.pixels.end());
        } else {
          return std::vector<double>(rows.values.begin(), rows.values.end());
        }
      },
      descriptors);
}

TEST_F(StoredDescriptorsTest, AreThoseOfTheRouteInAnyRange) {
  for (std::size_t t = 0; t < route_.traverses.size(); ++t) {
    const place::Traverse& traverse = route_.traverses[t];
    const StoredDescriptors stored(path_, t);
    ASSERT_EQ(stored.size(), traverse.keyframes.size());
    ASSERT_EQ(stored.kinds(), traverse.descriptors.size());
    for (std::size_t kind = 0; kind < stored.kinds(); ++kind) {
      EXPECT_EQ(stored.bytes_of_each(kind), place::bytes_of_each(traverse.descriptors[kind]));
      for (const std::size_t begin : {0U, 1U, 255U, 256U}) {
        for (const std::size_t end : {begin, begin + 1, std::size_t{256}, stored.size()}) {
          if (end < begin || end > stored.size()) continue;
          std::vector<std::size_t> expected(end - begin);
          std::iota(expected.begin(), expected.end(), begin);
          EXPECT_EQ(values_of(stored.read(kind, begin, end)),
                    values_of(place::select(traverse.descriptors[kind], expected)));
        }
      }
    }
  }
}

TEST_F(StoredDescriptorsTest, AreThoseOfSomeKeyframes) {
  const StoredDescriptors stored(path_, 0);
  for (const std::vector<std::size_t>& some :
       {std::vector<std::size_t>{}, std::vector<std::size_t>{0, 3, 255, 256, 511, 512, 599},
        std::vector<std::size_t>{599}}) {
    EXPECT_EQ(values_of(stored.read(1, some)),
              values_of(place::select(route_.traverses[0].descriptors[1], some)));
  }
  EXPECT_THROW((void)stored.read(0, std::vector<std::size_t>{600}), std::out_of_range);
  EXPECT_THROW((void)stored.read(0, std::vector<std::size_t>{5, 3}), std::out_of_range);
  EXPECT_THROW((void)stored.read(0, 3, 601), std::out_of_range);
}

TEST_F(StoredDescriptorsTest, ReadTheBlocksThatAreNeededOnly) {
  const StoredDescriptors stored(path_, 0);
  const std::size_t each = stored.bytes_of_each(0);
  (void)stored.read(0, 300, 310);
  EXPECT_EQ(stored.bytes_read(), 256 * each);
  (void)stored.read(0, 512, 600);
  EXPECT_EQ(stored.bytes_read(), (256 + 88) * each);
}

TEST_F(StoredDescriptorsTest, OfADamagedOrForeignFileAreRefused) {
  EXPECT_THROW_WITH(StoredDescriptors(path_, 7), vo::Error, "traverse 8 is missing");
  // One byte of the last chunk changes.
  std::fstream file(path_, std::ios::in | std::ios::out | std::ios::binary);
  const Descriptors& columns = route_.traverses[0].descriptors[0];
  const auto& values = std::get<place::ColumnStack>(columns).values;
  const std::string bytes(reinterpret_cast<const char*>(values.data()) + 5120, 40);
  std::string all((std::istreambuf_iterator<char>(file)), {});
  const std::size_t at = all.find(bytes);
  ASSERT_NE(at, std::string::npos);
  file.clear();
  file.seekp(static_cast<std::streamoff>(at));
  file.put(static_cast<char>(all[at] ^ 1));
  file.close();
  const StoredDescriptors stored(path_, 0);
  (void)stored.read(0, 0, 512);
  EXPECT_THROW_WITH((void)stored.read(0, 500, 600), vo::Error, "checksum");
}

TEST_F(StoredDescriptorsTest, LeaveARouteReadWithoutThemAsItIsOtherwise) {
  place::Route light = place::read_route(path_, {.previews = false, .descriptors = false});
  ASSERT_EQ(light.traverses.size(), route_.traverses.size());
  EXPECT_TRUE(light.traverses[0].descriptors.empty());
  EXPECT_EQ(light.traverses[0].keyframes.size(), route_.traverses[0].keyframes.size());
  EXPECT_TRUE(light.traverses[0].keyframes[8].preview_jpeg.empty());
  place::read_previews(path_, light, 0, std::vector<std::size_t>{8, 9});
  EXPECT_EQ(light.traverses[0].keyframes[8].preview_jpeg, route_.traverses[0].keyframes[8].preview_jpeg);
  EXPECT_TRUE(light.traverses[0].keyframes[9].preview_jpeg.empty());   // has none
  EXPECT_TRUE(light.traverses[0].keyframes[12].preview_jpeg.empty());  // was not asked for
}

TEST_F(StoredDescriptorsTest, MayBeReadAgainAndAgain) {
  const StoredDescriptors stored(path_, 0);
  const std::vector<double> once = values_of(stored.read(0, 0, stored.size()));
  // Well beyond what one reading of the whole file is allowed.
  const std::uint64_t enough = 4 * std::filesystem::file_size(path_) + (1U << 20U);
  while (stored.bytes_read() < enough) ASSERT_EQ(values_of(stored.read(0, 0, stored.size())), once);
}

TEST_F(StoredDescriptorsTest, TellOneRouteFromAnother) {
  const auto digest = place::read_route(path_).digest;
  ASSERT_TRUE(digest);
  EXPECT_EQ(StoredDescriptors(path_, 0).digest(), digest);
  place::Route other = route_;
  other.traverses[0].keyframes[0].displacement += 0.5;
  place::write_route(path_, other);
  EXPECT_NE(StoredDescriptors(path_, 0).digest(), digest);
  place::write_route(path_, route_);
  EXPECT_EQ(place::read_route(path_).digest, digest);
}

TEST_F(StoredDescriptorsTest, PicturesMayBeAskedForAgainAndAgain) {
  place::Route light = place::read_route(path_, {.previews = false, .descriptors = false});
  // More than one reading of the file may give: 16 bytes each time, and the picture.
  const std::size_t often = (2 * std::filesystem::file_size(path_) + (1U << 16U)) / 16 + 2;
  EXPECT_NO_THROW(place::read_previews(path_, light, 0, std::vector<std::size_t>(often, 8)));
}

TEST_F(StoredDescriptorsTest, OfNoSizeAreRefused) {
  place::sqlite::Database(path_, place::sqlite::Database::Mode::kCreate, "r.db")
      .run("UPDATE descriptor SET width = 0");
  EXPECT_THROW_WITH(StoredDescriptors(path_, 0), vo::Error, "is no size");
}

}  // namespace
