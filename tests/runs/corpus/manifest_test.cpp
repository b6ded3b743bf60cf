// The table of a corpus: its cells and words, and what is said of bad ones.

#include "runs/corpus/manifest.hpp"

#include <gtest/gtest.h>

#include "forward/base/text_file.hpp"
#include "tests/runs/temporary_folder.hpp"

namespace genio {
namespace {

using Words = std::vector<std::string>;

class ManifestOf : public testing::Test {
 protected:
  ManifestOf() {
    make_folder(folder.path() + "/s1");
    for (const char* name : {"s1/a.csv", "s1/b c.csv", "a.csv", "model.toml"})
      write_text(folder.path() + "/" + name, "x\n");
  }
  Manifest read(const std::string& text) const {
    write_text(folder.path() + "/m.csv", text);
    return read_manifest(folder.path() + "/m.csv", take);
  }
  std::string refusal(const std::string& text) const {
    try {
      read(text);
    } catch (const InputError& e) {
      return std::string(e.what()).substr(folder.path().size() + 1);
    }
    return "none";
  }
  /// Takes --target, --palate and --model, and refuses --bad.
  static InversionOptions take(const Words& words) {
    InversionOptions o;
    o.model = "/dev/null";
    for (size_t k = 0; k < words.size(); ++k) {
      if (words[k] == "--bad") throw InputError("--bad: is bad");
      if (words[k] == "--target") o.measured.target = words[k + 1];
      if (words[k] == "--palate") o.measured.palate = words[k + 1];
      if (words[k] == "--model") o.model = words[k + 1];
      if (words[k] == "--bite-plane") o.measured.bite_plane = words[k + 1];
    }
    return o;
  }
  test::TemporaryFolder folder;
};

TEST(QuotedCells, HoldSeparatorsAndQuotes) {
  EXPECT_EQ(quoted_cells(R"(a,"b,c","say ""d"", e",)", ','),
            (Words{"a", "b,c", "say \"d\", e", ""}));
  EXPECT_EQ(quoted_cells("a\t b ", '\t'), (Words{"a", " b "}));
  EXPECT_THROW(quoted_cells("a,\"b", ','), InputError);
}

TEST(WordsOf, AreHeldTogetherByQuotesOfEitherKind) {
  EXPECT_EQ(words_of(R"(--labels "a b",'c d' --x ""  y)"),
            (Words{"--labels", "a b,c d", "--x", "", "y"}));
  EXPECT_TRUE(words_of("  ").empty());
  EXPECT_THROW(words_of("--labels 'a"), InputError);
}

TEST_F(ManifestOf, PathsStartFromItsFolderAndTheModelIsNamed) {
  const Manifest m = read("Recording,options,speaker\ns1/a.csv,--starts 3,S1\n");
  ASSERT_EQ(m.rows.size(), 1u);
  EXPECT_EQ(m.rows[0].words,
            (Words{"--target", "s1/a.csv", "--starts", "3", "--model", "/dev/null"}));
  EXPECT_EQ(m.rows[0].speaker, "S1");
  EXPECT_EQ(asked_of(m.rows[0].words, m.folder, take).measured.target, folder.path() + "/s1/a.csv");
}

TEST_F(ManifestOf, FilesOfOptionsStartFromItsFolderToo) {
  const Manifest m = read("recording,options\ns1/a.csv,--bite-plane a.csv\n");
  EXPECT_EQ(asked_of(m.rows.at(0).words, m.folder, take).measured.bite_plane,
            folder.path() + "/a.csv");
  const std::string none = refusal("recording,options\ns1/a.csv,--bite-plane none.csv\n");
  EXPECT_NE(none.find("column options"), std::string::npos) << none;
  EXPECT_NE(none.find("none.csv: no such file"), std::string::npos) << none;
}

TEST_F(ManifestOf, PointsOfOptionsKeepTheirComma) {
  const Manifest m =
      read("recording,options\ns1/a.csv,\"--hyoid 120,-40.5 --jaw-shadow=-7,3 --ignore-marks\"\n");
  const auto& words = m.rows.at(0).words;
  ASSERT_GE(words.size(), 6u);
  EXPECT_EQ(Words(words.begin() + 2, words.begin() + 6),
            (Words{"--hyoid", "120,-40.5", "--jaw-shadow=-7,3", "--ignore-marks"}));
}

TEST_F(ManifestOf, FilesOfOneTakeAreFoundEach) {
  const Manifest m = read("recording\n\"s1/a.csv,a.csv\"\n");
  EXPECT_EQ(asked_of(m.rows[0].words, m.folder, take).measured.target,
            folder.path() + "/s1/a.csv," + folder.path() + "/a.csv");
  EXPECT_NE(refusal("recording\n\"s1/a.csv,none.csv\"\n").find("none.csv: no such file"),
            std::string::npos);
}

TEST_F(ManifestOf, NamesOfFoldersDifferAndStayWhenRowsAreAdded) {
  const std::string rows = "recording\ns1/a.csv\ns1/b c.csv\ns1/a.csv\na.csv\n";
  const Manifest before = read(rows), after = read(rows + "s1/../a.csv\n");
  std::vector<std::string> names;
  for (const ManifestRow& row : after.rows) names.push_back(row.name);
  EXPECT_EQ(names, (Words{"s1_a", "s1_b_c", "s1_a-2", "a", "a-2"}));
  for (size_t k = 0; k < before.rows.size(); ++k) EXPECT_EQ(before.rows[k].name, names[k]);
}

TEST_F(ManifestOf, ABadCellIsNamedByLineAndColumn) {
  EXPECT_EQ(refusal("recording,palate\n\ns1/a.csv,p.csv\n").substr(0, 23),
            "m.csv:3: column palate:");
  EXPECT_EQ(refusal("recording,options\ns1/a.csv,--bad\na.csv,\nb.csv,\n"),
            "m.csv:2: column options: --bad: is bad; also wrong: line 4");
  EXPECT_NE(refusal("recording,speaker\n,S1\n").find("m.csv:2: column recording: is empty"),
            std::string::npos);
  EXPECT_NE(refusal("recording\na.csv,b\n").find("m.csv:2: has 2 cells"), std::string::npos);
  EXPECT_NE(refusal("recording,modl\n").find("did you mean model?"), std::string::npos);
  EXPECT_NE(refusal("speaker\nS1\n").find("the column recording is missing"), std::string::npos);
  EXPECT_NE(refusal("recording,recording\n").find("twice"), std::string::npos);
  EXPECT_NE(refusal("recording\n").find("lists no recording"), std::string::npos);
}

TEST_F(ManifestOf, OptionsOfTheCorpusAndOfOtherColumnsAreRefused) {
  for (const char* option : {"--out", "--threads", "--resume", "--json", "--quiet", "--verbose"})
    EXPECT_NE(refusal(std::string("recording,options\na.csv,") + option + "\n")
                  .find(std::string(option) + " is the corpus's own"),
              std::string::npos)
        << option;
  for (const char* option : {"--target", "--palate", "--model", "--textgrid"})
    EXPECT_NE(
        refusal(std::string("recording,options\na.csv,") + option + "=x\n").find("in the column"),
        std::string::npos)
        << option;
}

}  // namespace
}  // namespace genio
