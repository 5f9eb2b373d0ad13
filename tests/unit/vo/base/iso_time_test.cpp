#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vo/base/iso_time.hpp>

namespace {

TEST(IsoTime, CountsFrom1970) {
  EXPECT_EQ(vo::parse_iso_time("1970-01-01T00:00:00Z"), 0);
  EXPECT_EQ(vo::parse_iso_time("2001-09-09T01:46:40Z"), 1e9);        // a billion seconds, as tables have it
  EXPECT_EQ(vo::parse_iso_time("2000-03-01T00:00:00Z"), 951868800);  // after a 29th of February
  EXPECT_EQ(vo::parse_iso_time("1969-12-31T23:59:59Z"), -1);
}

TEST(IsoTime, KnowsZonesAndFractions) {
  for (const char* same : {"2001-09-09T03:46:40+02:00", "2001-09-08T20:16:40-0530", "2001-09-09T02:46:40+01",
                           "2001-09-09 01:46:40", "2001-09-09T01:46:40.000Z", "2001-09-09t01:46:40z"})
    EXPECT_EQ(vo::parse_iso_time(same), 1e9) << same;
  EXPECT_DOUBLE_EQ(vo::parse_iso_time("2001-09-09T01:46:40.125Z").value(), 1e9 + 0.125);
  EXPECT_DOUBLE_EQ(vo::parse_iso_time("2001-09-09T01:46:40,5").value(), 1e9 + 0.5);
  EXPECT_EQ(vo::parse_iso_time("2016-12-31T23:59:60Z"), vo::parse_iso_time("2017-01-01T00:00:00Z"));
}

TEST(IsoTime, RefusesAllElse) {
  for (const char* wrong :
       {"", "2001", "2001-09-09", "2001-13-01T00:00:00Z", "2001-02-29T00:00:00Z", "2001-01-01T25:00:00Z",
        "2001-01-01T00:60:00Z", "2001-01-01T00:00:00ZZ", "2001-01-01T00:00:00+99:00", "2001-1-1T0:0:0Z",
        "2001-01-01X00:00:00Z", "2001-01-01T00:00:00+1", "-001-01-01T00:00:00Z", "2001-01-01T00:00:61Z",
        // before the year 1 and after 9999, which `iso_time` cannot write
        "0000-12-31T23:59:59Z", "0001-01-01T00:00:00+14:00", "9999-12-31T24:59:60Z"})
    EXPECT_FALSE(vo::parse_iso_time(wrong)) << wrong;
}

TEST(IsoTime, ThereAndBack) {
  EXPECT_EQ(vo::iso_time(0), "1970-01-01T00:00:00.000Z");
  EXPECT_EQ(vo::iso_time(1e9 + 0.0625), "2001-09-09T01:46:40.063Z");
  EXPECT_EQ(vo::iso_time(-0.5), "1969-12-31T23:59:59.500Z");
  for (const double t : {951782399.999, 4102444800.0, -2208988800.25})
    EXPECT_NEAR(vo::parse_iso_time(vo::iso_time(t)).value(), t, 5e-4) << t;  // half a millisecond
  EXPECT_THROW(vo::iso_time(1e18), std::invalid_argument);
  EXPECT_THROW(vo::iso_time(-1e12), std::invalid_argument);
}

}  // namespace
