#include "server/base/safe_text.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace genio {
namespace {

TEST(SafeText, TimesAreIso8601InUtc) {
  EXPECT_EQ(utc_text(0, 3), "-");
  EXPECT_EQ(utc_text(1, 6), "1970-01-01T00:00:00.000001Z");
  EXPECT_EQ(utc_text(-1, 3), "1969-12-31T23:59:59.999Z");
  EXPECT_EQ(utc_text(1'709'210'096'789'012, 3), "2024-02-29T12:34:56.789Z");
  EXPECT_EQ(utc_text(253'402'300'799'999'999, 6), "9999-12-31T23:59:59.999999Z");
  EXPECT_EQ(utc_text(253'402'300'800'000'000, 6), "253402300800000000 us");
  EXPECT_EQ(utc_text(std::numeric_limits<int64_t>::min(), 3), "-9223372036854775808 us");
}

TEST(SafeText, WhatATerminalMightObeyIsEscaped) {
  EXPECT_EQ(escaped_text("plain-1 \xc3\xa4\xe2\x82\xac\xf0\x9f\x91\x85"),
            "plain-1 \xc3\xa4\xe2\x82\xac\xf0\x9f\x91\x85");
  EXPECT_EQ(escaped_text(std::string("\0\t\x1b[31m\n\x7f", 9)), R"(\x00\x09\x1b[31m\x0a\x7f)");
  EXPECT_EQ(escaped_text("a\\x00"), R"(a\\x00)");
  EXPECT_EQ(escaped_text("\xc2\x9b"), R"(\xc2\x9b)");          // a control of C1
  EXPECT_EQ(escaped_text("\xe2\x80\xae"), R"(\xe2\x80\xae)");  // right to left
  // What is no UTF-8: alone, cut off, longer than it need be, a surrogate, too large.
  for (const char* bytes : {"\xff", "\xc3", "\xe2\x82", "\xc0\xaf", "\xed\xa0\x80",
                            "\xf4\x90\x80\x80", "\xf5\x80\x80\x80"}) {
    const std::string text = escaped_text(bytes);
    EXPECT_EQ(text.size(), 4 * std::string(bytes).size()) << text;
    EXPECT_EQ(text.find_first_of("\xff\xc3\x82"), std::string::npos);
  }
  EXPECT_EQ(escaped_text("\xe2\x82x"), R"(\xe2\x82x)");
}

TEST(SafeText, ACutEndsWithAWholeSign) {
  EXPECT_EQ(cut_text("abc", 3), "abc");
  EXPECT_EQ(cut_text("abcd", 3), "abc");
  EXPECT_EQ(cut_text("ab\xc3\xa4", 3), "ab");
  EXPECT_EQ(cut_text("\xf0\x9f\x91\x85!", 4), "\xf0\x9f\x91\x85");
  EXPECT_EQ(cut_text("\xf0\x9f\x91\x85!", 3), "");
  // What is no UTF-8 loses three bytes at most.
  EXPECT_EQ(cut_text(std::string(100, '\x80'), 50).size(), 47u);
}

}  // namespace
}  // namespace genio
