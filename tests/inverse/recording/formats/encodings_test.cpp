// A text table reads the same in every encoding and with every decimal mark and separator that
// leave no doubt; else the message says what it is.

#include "inverse/recording/format_list.hpp"
#include "tests/inverse/recording/formats/formats_fixture.hpp"

namespace genio {
namespace {

std::string as_utf16(const std::string& ascii, bool big_first, bool mark) {
  std::string bytes;
  for (const char c : (mark ? "\x01" : "") + ascii) {
    const char high = c == 1 ? '\xFE' : '\0', low = c == 1 ? '\xFF' : c;
    bytes += big_first ? std::string{high, low} : std::string{low, high};
  }
  return bytes;
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
    text.replace(at, from.size(), to);
  return text;
}

/// A comma for the point of each number, and a semicolon for each comma between fields.
std::string with_decimal_commas(std::string text) {
  text = replaced(text, ",", ";");
  const auto digit = [](char c) { return c >= '0' && c <= '9'; };
  for (size_t k = 1; k + 1 < text.size(); ++k)
    if (text[k] == '.' && digit(text[k - 1]) && digit(text[k + 1])) text[k] = ',';
  return text;
}

class Encodings : public Formats {
 protected:
  static std::vector<ContourFormat> of_text(Content content) {
    std::vector<ContourFormat> formats;
    for (const ContourFormat& format : contour_formats()) {
      const std::string& text = format.example.text;
      const bool binary = std::any_of(text.begin(), text.end(), [](char c) {
        return (c >= 0 && c < ' ' && c != '\n' && c != '\t') || c < 0;
      });
      const bool header_of_bytes = format.traits.name == "est";  // samples behind it may be binary
      if (format.traits.content == content && !binary && !header_of_bytes)
        formats.push_back(format);
    }
    return formats;
  }
  /// Empty where the text reads as the format's example does, else what differs.
  std::string difference(const ContourFormat& format, const std::string& text) {
    const auto whole =
        read_raw(write(format.example.name, format.example.text), format.example.options);
    RawContours read;
    try {
      read = read_raw(write(format.example.name, text), format.example.options);
    } catch (const InputError& e) {
      return e.what();
    }
    if (read.file.format.name != format.traits.name) return "format " + read.file.format.name;
    if (read.file.frames.size() != whole.file.frames.size()) return "frames";
    for (size_t k = 0; k < whole.file.frames.size(); ++k) {
      const ContourFrame &a = read.file.frames[k], &b = whole.file.frames[k];
      if (a.number != b.number || a.time_s != b.time_s || a.label != b.label ||
          a.points.size() != b.points.size())
        return "a frame";
      for (size_t i = 0; i < a.points.size(); ++i)
        if (a.points[i].kind != b.points[i].kind ||
            a.points[i].position[0] != b.points[i].position[0] ||
            a.points[i].position[2] != b.points[i].position[2])
          return "a point";
    }
    return "";
  }
};

TEST_F(Encodings, MarksAndLineEndsChangeNothing) {
  for (const Content content : {Content::curves, Content::sensors})
    for (const ContourFormat& format : of_text(content)) {
      SCOPED_TRACE(format.traits.name);
      const std::string& text = format.example.text;
      EXPECT_EQ(difference(format, replaced(text, "\n", "\r\n")), "");
      EXPECT_EQ(difference(format, replaced(text, "\n", "\r")), "");
      EXPECT_EQ(difference(format, text + "\n \n"), "");
      EXPECT_EQ(difference(format, "\xEF\xBB\xBF" + text), "");
      EXPECT_EQ(difference(format, as_utf16(text, false, true)), "");
      EXPECT_EQ(difference(format, as_utf16(text, true, true)), "");
    }
}

TEST_F(Encodings, NulBytesAndUtf16WithoutItsMarkAreNamed) {
  for (const Content content : {Content::curves, Content::sensors})
    for (const ContourFormat& format : of_text(content)) {
      SCOPED_TRACE(format.traits.name);
      const std::string& text = format.example.text;
      for (const std::string& bad : {as_utf16(text, false, false), as_utf16(text, true, false),
                                     std::string(text).insert(text.size() - 3, 1, '\0')})
        EXPECT_NE(difference(format, bad).find("NUL byte"), std::string::npos)
            << difference(format, bad);
    }
}

TEST_F(Encodings, DecimalCommasBetweenSemicolonsTabsAndBlanksAreNumbers) {
  for (const Content content : {Content::curves, Content::sensors})
    for (const ContourFormat& format : of_text(content)) {
      SCOPED_TRACE(format.traits.name);
      EXPECT_EQ(difference(format, with_decimal_commas(format.example.text)), "");
    }
}

TEST_F(Encodings, LatinLettersOfALabelComeOutAsUtf8) {
  const auto label = [&](const std::string& text) {
    return read_raw(write("l.csv", text), {}).file.frames.front().label;
  };
  const std::string header = "frame,point,x_mm,z_mm,label\n1,1,60,95,";
  EXPECT_EQ(label(header + "\xE9t\xE9\n"), "\xC3\xA9t\xC3\xA9");
  EXPECT_EQ(label(header + "\xC3\xA9t\xC3\xA9\n"), "\xC3\xA9t\xC3\xA9");
}

}  // namespace
}  // namespace genio
