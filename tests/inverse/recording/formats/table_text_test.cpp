// Text tables as people's programs save them.

#include "inverse/recording/base/table_text.hpp"

#include "tests/inverse/recording/formats/formats_fixture.hpp"

namespace genio {
namespace {

const std::string table = "frame,point,x_mm,z_mm,label\n1,1,60,95,a\n1,2,90,115,a\n";

std::string utf16(const std::string& text, bool little) {
  std::string result = little ? "\xFF\xFE" : "\xFE\xFF";
  for (const char c : text) {
    if (!little) result += '\0';
    result += c;
    if (little) result += '\0';
  }
  return result;
}

TEST_F(Formats, EncodingsAndLineEndsMakeNoDifference) {
  std::string cr = table, crlf;
  for (char& c : cr)
    if (c == '\n') c = '\r';
  for (const char c : table) crlf += c == '\n' ? std::string("\r\n") : std::string(1, c);
  for (const std::string& text : {table, cr, crlf, "\xEF\xBB\xBF" + table, utf16(table, true),
                                  utf16(table, false), utf16(crlf, true), "\n\n" + table}) {
    const auto f = read_contours(write("t.csv", text));
    ASSERT_EQ(f.frames.size(), 1u);
    ASSERT_EQ(f.frames[0].points.size(), 2u);
    EXPECT_DOUBLE_EQ(f.frames[0].points[1].position[0], 0.09);
    EXPECT_EQ(f.frames[0].label, "a");
  }
}

TEST_F(Formats, LabelsBecomeUtf8) {
  for (const std::string& label : {std::string("\xE4"), std::string("\xC3\xA4")}) {
    const auto f = read_contours(write("t.csv", "frame,x_mm,z_mm,label\n1,60,95," + label + "\n"));
    EXPECT_EQ(f.frames[0].label, "\xC3\xA4");
  }
}

TEST_F(Formats, NulBytesAndEndlessLinesAreNamed) {
  EXPECT_NE(error(write("n.csv", table + std::string("1,3,\0,5,a\n", 10))).find(":4: has a NUL"),
            std::string::npos);
  EXPECT_NE(error(write("l.csv", std::string(5 << 20, '7'))).find(":1: the line is longer than"),
            std::string::npos);
  EXPECT_NE(error(folder.string()).find("is a folder"), std::string::npos);
}

TEST_F(Formats, DecimalCommasAreReadWhereNothingElseTheyCanBe) {
  const auto f = read_contours(write("c.csv", "frame;x_mm;z_mm\n1;60,25;95\n1;90,5;115,125\n"));
  ASSERT_EQ(f.frames.size(), 1u);
  EXPECT_DOUBLE_EQ(f.frames[0].points[1].position[2], 0.115125);
  EXPECT_TRUE(says(f, "decimal commas"));
  EXPECT_NE(error(write("m.csv", "frame;x_mm;z_mm\n1;60.5;95\n1;90,5;115\n"))
                .find(":3: field x_mm: '90,5': a decimal comma?"),
            std::string::npos);
  EXPECT_NE(error(write("q.csv", "frame,x_mm,z_mm\n1,\"60,5\",95\n")).find("a decimal comma?"),
            std::string::npos);
  EXPECT_NE(error(write("n.csv", "frame,x_mm,z_mm\n1,60,5,95,5\n")).find("Decimal commas"),
            std::string::npos);
}

TEST(TableText, QuotedFieldsHoldTheirSeparators) {
  EXPECT_EQ(split_fields("1,\"a,b\",2", ','), (std::vector<std::string>{"1", "\"a,b\"", "2"}));
  EXPECT_EQ(split_fields("\"a,b", ','), (std::vector<std::string>{"\"a", "b"}));
  EXPECT_EQ(split_fields("1,\"a,b\"", ',').size(), 2u);
  EXPECT_EQ(split_fields("", ',').size(), 1u);
  EXPECT_EQ(split_fields("a,", ',').size(), 2u);
  EXPECT_EQ(split_at_blanks("  \"a b\"  2 ").size(), 2u);
}

TEST(TableText, NumbersAreExactOrNone) {
  double v = 7;
  for (const char* text : {"", "*", "nan", "inf", "1e999", "0x10", "1,5", "1.5mm", "+-1", "--1"})
    EXPECT_FALSE(parse_number(text, v)) << text;
  EXPECT_EQ(v, 7);
  EXPECT_TRUE(parse_number(" +0.1 ", v));
  EXPECT_EQ(v, 0.1);
}

}  // namespace
}  // namespace genio
