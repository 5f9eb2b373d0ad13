#include "route/descriptor_rows.hpp"

#include "support/random_images.hpp"
#include "support/temporary_folder.hpp"

#include <algorithm>
#include <numeric>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <place/describe/quantise.hpp>
#include <vo/base/error.hpp>

namespace {

namespace rows = place::descriptor_rows;
using place::sqlite::Database;
using place::sqlite::Statement;
using test_support::TemporaryFolder;
using testing::ElementsAre;

constexpr std::size_t kSize = 3;  // bytes of a row

/// A table of chunks of `count` rows that count up, and what lies in it.
struct Table {
  explicit Table(std::size_t count)
      : database(folder / "rows.db", Database::Mode::kCreate, "rows.db"), bytes(count * kSize) {
    std::iota(bytes.begin(), bytes.end(), std::uint8_t{0});
    database.run("CREATE TABLE chunk(owner INTEGER, first INTEGER, checksum INTEGER, bytes BLOB)");
    Statement insert = database.prepare("INSERT INTO chunk VALUES(?,?,?,?)");
    rows::write_chunks(insert, bytes, kSize, count, [](Statement& chunk) { chunk.bind(std::int64_t{7}); });
  }

  [[nodiscard]] std::vector<std::uint8_t> read(std::size_t count) const {
    Statement select = database.prepare("SELECT checksum, bytes FROM chunk WHERE owner = 7 ORDER BY first");
    std::vector<std::uint8_t> read(count * kSize);
    rows::read_chunks(select, read, "rows.db", "rows");
    return read;
  }

  TemporaryFolder folder;
  Database database;
  std::vector<std::uint8_t> bytes;
};

TEST(DescriptorRows, ChecksumIsFnvOverWords) {
  // By hand from the definition: hash = (hash ^ word) * prime, starting at the offset basis.
  const std::uint64_t basis = 0xcbf29ce484222325U, prime = 0x100000001b3U;
  EXPECT_EQ(static_cast<std::uint64_t>(rows::checksum({})), basis);
  const std::vector<std::uint8_t> nine{1, 0, 0, 0, 0, 0, 0, 0x80, 5};
  const std::uint64_t once = (basis ^ 0x8000000000000001U) * prime;
  EXPECT_EQ(static_cast<std::uint64_t>(rows::checksum(nine)), (once ^ 5U) * prime);
}

TEST(DescriptorRows, RoundTripInChunksOf256) {
  for (const std::size_t count : {0, 1, 255, 256, 257, 600}) {
    const Table table(count);
    EXPECT_EQ(table.read(count), table.bytes) << count;
    Statement firsts = table.database.prepare("SELECT count(*) FROM chunk");
    ASSERT_TRUE(firsts.step());
    EXPECT_EQ(firsts.integer(), static_cast<std::int64_t>((count + 255) / 256));
  }
}

TEST(DescriptorRows, FindMissingAdditionalAndChangedBytes) {
  const Table table(300);
  EXPECT_THROW_WITH(static_cast<void>(table.read(301)), vo::Error, "rows.db: is damaged: rows are missing");
  EXPECT_THROW_WITH(static_cast<void>(table.read(299)), vo::Error, "there are more rows than keyframes");
  table.database.run("UPDATE chunk SET bytes = x'000102' || substr(bytes, 5) WHERE first = 256");
  EXPECT_THROW_WITH(static_cast<void>(table.read(300)), vo::Error,
                    "a block of rows does not fit its checksum");
}

TEST(DescriptorRows, EveryFormIsMadeAsItWas) {
  place::ColumnStack columns = place::make_column_stack(2, 5, 4);
  place::FloatRows floats = place::make_float_rows(3, 4);
  const place::Descriptors each[] = {test_support::random_images(8, 4, 4, 1), columns, floats};
  const std::size_t sizes[] = {32, 10, 12};
  for (std::size_t i = 0; i < std::size(each); ++i) {
    const rows::Form form = rows::form_of(each[i]);
    EXPECT_EQ(form.bytes, sizes[i]);
    const auto made = rows::make_of_form(form.name, form.width, form.height, 4);
    ASSERT_TRUE(made.has_value());
    EXPECT_EQ(rows::form_of(*made), form);
    EXPECT_EQ(rows::bytes_of(*made).size(), rows::bytes_of(each[i]).size());
    EXPECT_TRUE(std::ranges::all_of(rows::bytes_of(*made), [](std::uint8_t b) { return b == 0; }));
  }
}

TEST(DescriptorRows, NoFormOfWrongSizesOrNames) {
  EXPECT_FALSE(rows::make_of_form("pixel", 2, 2, 1));
  EXPECT_FALSE(rows::make_of_form("pixels", -1, 2, 1));
  EXPECT_FALSE(rows::make_of_form("columns", 1 << 13, 1 << 12, 0));  // 32 MB for one
  EXPECT_FALSE(rows::make_of_form("floats", 4, 2, 1));
}

}  // namespace
