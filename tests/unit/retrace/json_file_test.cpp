#include "json_file.hpp"

#include "support/temporary_folder.hpp"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace {

using nlohmann::ordered_json;
using test_support::TemporaryFolder;
using testing::ElementsAre;

TEST(JsonFile, IsAnEmptyObjectWhereThereIsNone) {
  const TemporaryFolder folder;
  EXPECT_EQ(retrace::read_json_object(folder / "none"), ordered_json::object());
  for (const char* text : {"", "[1]", "{", "{\"a\": 1} x", "\"text\"", "{\"a\": \"\xFF\"}"})
    EXPECT_EQ(retrace::read_json_object(folder.write("t", text)), ordered_json::object()) << text;
  EXPECT_EQ(retrace::read_json_object(folder.write("t", "{\"a\": [1, {\"b\": 2}]}")).dump(),
            "{\"a\":[1,{\"b\":2}]}");
}

TEST(JsonFile, LeavesOutWhatLiesDeep) {
  // A page that writes it out again would call itself a million times.
  const TemporaryFolder folder;
  constexpr std::size_t kDeep = 1'000'000;
  const std::string text = "{\"a\": " + std::string(kDeep, '[') + std::string(kDeep, ']') + ", \"b\": 7}";
  const ordered_json json = retrace::read_json_object(folder.write("t", text));
  EXPECT_EQ(retrace::count_in(json, "b"), 7);
  EXPECT_LT(json.dump().size(), 50U);
}

TEST(JsonFile, GivesMembersOfTheKindAskedFor) {
  const auto json = ordered_json::parse(
      R"({"n": 1.5, "i": 3, "below": -3, "much": 1e300, "t": "x", "a": [1, "x", null, 2.5],)"
      R"( "o": {"t": "y"}, "b": true})");
  EXPECT_EQ(retrace::number_in(json, "n"), 1.5);
  EXPECT_EQ(retrace::number_in(json, "t"), std::nullopt);
  EXPECT_EQ(retrace::number_in(json, "none"), std::nullopt);
  EXPECT_EQ(retrace::count_in(json, "i"), 3);
  for (const char* none : {"n", "below", "much", "t", "a", "b"})
    EXPECT_EQ(retrace::count_in(json, none), std::nullopt) << none;
  EXPECT_EQ(retrace::text_in(json, "t"), "x");
  EXPECT_EQ(retrace::text_in(json, "i"), std::nullopt);
  EXPECT_EQ(retrace::text_in(retrace::member(json, "o"), "t"), "y");
  EXPECT_EQ(retrace::text_in(retrace::member(json, "a"), "t"), std::nullopt);  // of no object
  EXPECT_THAT(retrace::texts_in(json, "a"), ElementsAre("x"));
  EXPECT_THAT(retrace::texts_in(json, "o"), ElementsAre());
  const std::vector<double> numbers = retrace::numbers_in(json, "a");
  ASSERT_EQ(numbers.size(), 4U);
  EXPECT_EQ(numbers[3], 2.5);
  EXPECT_TRUE(std::isnan(numbers[1]) && std::isnan(numbers[2]));
  EXPECT_THAT(retrace::numbers_in(json, "o"), ElementsAre());
}

TEST(JsonFile, WritesNamesThatAreNoUtf8) {
  EXPECT_EQ(retrace::json_text({{"walk", "caf\xE9.mp4"}}), "{\"walk\":\"caf\xEF\xBF\xBD.mp4\"}");
  EXPECT_EQ(retrace::json_text({{"walk", "caf\xC3\xA9"}}, 2), "{\n  \"walk\": \"caf\xC3\xA9\"\n}");
}

}  // namespace
