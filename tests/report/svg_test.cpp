#include "report/pictures/svg.hpp"

#include "forward/base/text_file.hpp"
#include "forward/base/types.hpp"
#include "tests/report/markup.hpp"

namespace genio {
namespace {

using test::Folder;

TEST(Axes, MapCornersOfTheDataToCornersOfThePicture) {
  const Axes axes{-2, 6, 10, 30, 50, 40, 400, 100};
  EXPECT_DOUBLE_EQ(axes.px(-2), 50);
  EXPECT_DOUBLE_EQ(axes.px(6), 450);
  EXPECT_DOUBLE_EQ(axes.py(30), 40);  // up in the data is up in the picture
  EXPECT_DOUBLE_EQ(axes.py(10), 140);
}

TEST(Axes, ReturnADataPointFromItsPixels) {
  const Axes axes{-2, 6, 10, 30, 50, 40, 400, 100};
  const Axes back{50, 450, 40, 140, -2, 10, 8, 20};  // of the pixels, onto the data
  for (double x : {-2.0, 0.0, 1.7, 6.0}) EXPECT_NEAR(back.px(axes.px(x)), x, 1e-12);
  for (double y : {10.0, 14.2, 30.0}) EXPECT_NEAR(back.py(axes.py(y)), y, 1e-12);
}

TEST(Svg, StaysWellFormedWhateverItsWordsAre) {
  const std::string words = "a < b & c > \"d\" 'e' &amp; </text>";
  Svg svg(100, 50);
  svg.text(1, 2, words, 10, "start");
  pugi::xml_document document;
  test::parse(svg.str(), document);
  EXPECT_EQ(test::texts(document), std::vector<std::string>{words});
}

TEST(Svg, EndsALineWhereItsFrameEnds) {
  const Axes axes{0, 1, 0, 1, 10, 10, 80, 30};
  Svg svg(100, 50);
  svg.polyline(axes, {{0.2, 0.2}, {0.8, 0.8}}, {"black"});
  pugi::xml_document inside;
  test::parse(svg.str(), inside);
  EXPECT_FALSE(inside.child("svg").child("svg"));
  svg.polyline(axes, {{0.2, 0.2}, {1.5, 0.8}}, {"black"});
  pugi::xml_document outside;
  test::parse(svg.str(), outside);
  const auto frame = outside.child("svg").child("svg");
  EXPECT_EQ(frame.attribute("width").as_double(), axes.width);
  EXPECT_TRUE(frame.child("polyline"));
}

/// Width and height of a PNG file, from its first chunk.
std::pair<int, int> png_size(const std::string& bytes) {
  const auto number = [&](size_t at) {
    int value = 0;
    for (size_t i = 0; i < 4; ++i) value = 256 * value + static_cast<unsigned char>(bytes[at + i]);
    return value;
  };
  return {number(16), number(20)};
}

TEST(Png, HasTheSizeAskedFor) {
  const Folder folder;
  Svg svg(120, 60);
  svg.line(0, 0, 120, 60, {"black"});
  for (double scale : {1.0, 1.5}) {
    write_png(folder / "drawing.png", svg.str(), scale);
    const std::string bytes = test::content(folder / "drawing.png");
    ASSERT_GT(bytes.size(), 24u);
    EXPECT_EQ(bytes.substr(1, 3), "PNG");
    EXPECT_EQ(png_size(bytes), std::pair(int(120 * scale), int(60 * scale)));
  }
}

TEST(Png, OfWhatIsNoDrawingIsRefused) {
  const Folder folder;
  EXPECT_THROW(write_png(folder / "drawing.png", "no drawing", 1), std::runtime_error);
}

TEST(Files, ThatCannotBeWrittenAreInputErrorsWithTheirPath) {
  const Folder folder;
  const std::string path = folder / "nowhere/picture";
  const auto names_path = [&](auto write) {
    try {
      write();
      ADD_FAILURE() << "nothing was thrown";
    } catch (const InputError& e) {
      EXPECT_NE(std::string(e.what()).find(path), std::string::npos) << e.what();
    }
  };
  names_path([&] { write_text(path, "words"); });
  names_path([&] { write_png(path, Svg(10, 10).str(), 1); });
}

}  // namespace
}  // namespace genio
