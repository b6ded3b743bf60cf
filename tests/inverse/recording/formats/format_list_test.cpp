// Each format of the list is known by its own example; a file of none is asked about.

#include "inverse/recording/format_list.hpp"

#include <set>

#include "tests/inverse/recording/formats/formats_fixture.hpp"

namespace genio {
namespace {

TEST_F(Formats, EveryFormatReadsItsOwnExampleAndKnowsIt) {
  std::set<std::string> names;
  for (const ContourFormat& format : contour_formats()) {
    SCOPED_TRACE(format.traits.name);
    EXPECT_TRUE(names.insert(format.traits.name).second);
    EXPECT_FALSE(format.about.empty());
    EXPECT_GT(format.traits.noise, 0);
    const auto path = write(format.example.name, format.example.text);
    EXPECT_EQ(&format_of(path), &format);
    EXPECT_EQ(&format_named(format.traits.name), &format);
    EXPECT_NE(format_choices().find(format.traits.name), std::string::npos);
    const auto found = read_contours(path, format.example.options);
    EXPECT_EQ(found.format.name, format.traits.name);
    EXPECT_EQ(found.format.content, format.traits.content);
    ASSERT_FALSE(found.frames.empty());
    EXPECT_FALSE(found.frames.front().points.empty());
    ReadOptions named = format.example.options;
    named.format = format.traits.name;
    EXPECT_EQ(read_contours(path, named).remarks, found.remarks);
  }
}

TEST_F(Formats, AnUnknownNameSuggestsTheNearest) {
  ReadOptions o;
  o.format = "egdetrak";
  const std::string said = error(write("p.csv", "1,2\n"), o);
  EXPECT_NE(said.find("--format egdetrak: unknown; did you mean edgetrak?"), std::string::npos);
  EXPECT_NE(said.find("or csv"), std::string::npos);
}

TEST_F(Formats, AFileThatNoFormatKnowsIsAskedAbout) {
  EXPECT_NE(error(write("x.txt", "\nwords\n")).find("x.txt:2: neither tab-separated"),
            std::string::npos);
  EXPECT_NE(error((folder / "absent.txt").string()).find("no such file"), std::string::npos);
}

TEST_F(Formats, AFileOfNobodysSizeIsAskedAbout) {
  std::string text;
  for (const Vec2& q : line) text += fmt::format("{},{}\n", 9 * q[0], 9 * q[1]);
  EXPECT_NE(error(write("px.csv", text)).find("--units"), std::string::npos);
  ReadOptions o;
  o.units = "furlong";
  EXPECT_NE(error(write("px.csv", text), o).find("expected mm, cm, m, um or px"),
            std::string::npos);
}

}  // namespace
}  // namespace genio
