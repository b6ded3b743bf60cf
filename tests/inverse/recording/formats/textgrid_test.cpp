// Praat's TextGrids in the forms and encodings that Praat saves.

#include "inverse/recording/textgrid.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "forward/base/types.hpp"
#include "inverse/recording/base/unicode.hpp"

namespace genio {
namespace {

const std::string long_form =
    "File type = \"ooTextFile\"\nObject class = \"TextGrid\"\n\nxmin = 0 \nxmax = 2.5 \n"
    "tiers? <exists> \nsize = 2 \nitem []: \n    item [1]:\n        class = \"IntervalTier\" \n"
    "        name = \"phones 2\" \n        xmin = 0 \n        xmax = 2.5 \n"
    "        intervals: size = 2 \n        intervals [1]:\n            xmin = 0 \n"
    "            xmax = 1.25 \n            text = \"\" \n        intervals [2]:\n"
    "            xmin = 1.25 \n            xmax = 2.5 \n            text = \"a \"\"long\"\" "
    "\xC9\x91\" \n"
    "    item [2]:\n        class = \"TextTier\" \n        name = \"bursts\" \n"
    "        xmin = 0 \n        xmax = 2.5 \n        points: size = 1 \n        points [1]:\n"
    "            number = 0.75 \n            mark = \"t\" \n";

const std::string short_form =
    "File type = \"ooTextFile\"\nObject class = \"TextGrid\"\n\n0\n2.5\n<exists>\n2\n"
    "\"IntervalTier\"\n\"phones 2\"\n0\n2.5\n2\n0\n1.25\n\"\"\n1.25\n2.5\n"
    "\"a \"\"long\"\" \xC9\x91\"\n\"TextTier\"\n\"bursts\"\n0\n2.5\n1\n0.75\n\"t\"\n";

/// U+0251 is the only character of these texts beyond ASCII.
std::string in_utf16(const std::string& text, bool big_first) {
  std::string bytes = big_first ? "\xFE\xFF" : "\xFF\xFE";
  const auto put = [&](int high, int low) {
    bytes += char(big_first ? high : low);
    bytes += char(big_first ? low : high);
  };
  for (size_t i = 0; i < text.size(); ++i)
    if (text.compare(i, 2, "\xC9\x91") == 0) put(0x02, 0x51), ++i;
    else put(0, text[i]);
  return bytes;
}

class TextGrids : public testing::Test {
 protected:
  ~TextGrids() override { std::filesystem::remove(path); }
  std::vector<TextGridTier> read(const std::string& text) const {
    std::ofstream(path, std::ios::binary) << text;
    return read_textgrid(path);
  }
  std::string refusal(const std::string& text) const {
    try {
      read(text);
    } catch (const InputError& e) {
      return e.what();
    }
    return "none";
  }
  const std::string path =
      (std::filesystem::temp_directory_path() / ("genio-" + std::to_string(getpid()) + ".TextGrid"))
          .string();
};

TEST_F(TextGrids, AllFormsAndEncodingsSayTheSame) {
  for (const std::string& text :
       {long_form, short_form, "\xEF\xBB\xBF" + long_form, in_utf16(long_form, true),
        in_utf16(long_form, false), in_utf16(short_form, true),
        in_utf16(short_form, false).substr(2)}) {
    const auto tiers = read(text);
    ASSERT_EQ(tiers.size(), 2u);
    EXPECT_EQ(tiers[0].name, "phones 2");
    EXPECT_FALSE(tiers[0].points);
    ASSERT_EQ(tiers[0].labels.size(), 2u);
    EXPECT_EQ(tiers[0].labels[0].label, "");
    EXPECT_EQ(tiers[0].labels[1].label, "a \"long\" \xC9\x91");
    EXPECT_EQ(tiers[0].labels[1].middle_s(), 1.875);
    EXPECT_TRUE(tiers[1].points);
    ASSERT_EQ(tiers[1].labels.size(), 1u);
    EXPECT_EQ(tiers[1].labels[0].middle_s(), 0.75);
    EXPECT_EQ(tiers[1].labels[0].label, "t");
  }
}

TEST_F(TextGrids, LatinLettersAreReadWhereTheTextIsNoUtf8) {
  std::string text = short_form;
  text.replace(text.find("\xC9\x91"), 2, "\xE9");
  EXPECT_EQ(read(text)[0].labels[1].label, "a \"long\" \xC3\xA9");
}

TEST_F(TextGrids, WhatIsCutOffOrNoneIsNamedWithItsLine) {
  EXPECT_NE(refusal(short_form.substr(0, short_form.size() - 8)).find("the file ends"),
            std::string::npos);
  EXPECT_NE(refusal(short_form.substr(0, short_form.size() - 2)).find("has no end"),
            std::string::npos);
  EXPECT_NE(refusal("frame,point\n1,2\n").find("ooTextFile"), std::string::npos);
  EXPECT_NE(refusal("").find("the file ends"), std::string::npos);
  EXPECT_NE(refusal("ooBinaryFile\bTextGrid").find("binary"), std::string::npos);
  std::string text = short_form;
  text.replace(text.find("1.25\n2.5"), 4, "9.25");
  EXPECT_NE(refusal(text).find("ends before it starts"), std::string::npos) << refusal(text);
  EXPECT_NE(refusal(text).find(".TextGrid:17:"), std::string::npos) << refusal(text);
}

TEST_F(TextGrids, ATierThatIsNotThereIsRefusedWithThoseThatAre) {
  const auto tiers = read(long_form);
  EXPECT_EQ(tier_named(tiers, "bursts", path).name, "bursts");
  for (const char* name : {"phones", ""}) try {
      tier_named(tiers, name, path);
      FAIL() << "there is no such tier";
    } catch (const InputError& e) {
      const std::string what = e.what();
      EXPECT_NE(what.find("phones 2 (2 intervals), bursts (1 points)"), std::string::npos) << what;
      if (*name) {
        EXPECT_NE(what.find("did you mean phones 2?"), std::string::npos) << what;
      }
    }
}

TEST(UnicodeText, PairsOfUtf16AreOneCharacter) {
  EXPECT_EQ(utf8_of(std::string("\xFE\xFF\xD8\x3D\xDE\x00", 6)), "\xF0\x9F\x98\x80");
  EXPECT_EQ(utf8_of(std::string("\xFE\xFF\xD8\x3D", 4)), "\xEF\xBF\xBD");
}

}  // namespace
}  // namespace genio
