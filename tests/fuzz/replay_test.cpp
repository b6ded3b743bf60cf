// Every reader answers any bytes with what it read, or with InputError.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <ostream>
#include <random>

#include "tests/fuzz/fuzz_folder.hpp"

namespace genio::test {

/// What GoogleTest writes of a row.
void PrintTo(const FuzzReader& reader, std::ostream* out) { *out << reader.file; }

namespace {

namespace fs = std::filesystem;

const fs::path corpus = GENIO_SOURCE_DIR "/tests/fuzz/corpus";

/// The text with a few bytes changed, lost or repeated.
std::string broken(std::string text, std::mt19937& random) {
  const std::string bytes("\0\t\n\r ,;.\"-*0919eEXY\xFF\xFE\xE4", 22);
  for (unsigned k = random() % 4 + 1; k > 0 && !text.empty(); --k) {
    const size_t at = random() % text.size(), length = random() % 12 + 1;
    switch (random() % 6) {
      case 0:
        text[at] = bytes[random() % bytes.size()];
        break;
      case 1:
        text.erase(at, length);
        break;
      case 2:
        text.insert(at, text.substr(random() % text.size(), length * 4));
        break;
      case 3:
        text.insert(at, 1, bytes[random() % bytes.size()]);
        break;
      case 4:
        text[at] = char(random());
        break;
      default:
        text.resize(at);
        break;
    }
  }
  return text;
}

class Readers : public testing::TestWithParam<FuzzReader> {};

TEST_P(Readers, ReadTheirSeeds) {
  FuzzFolder folder(GetParam());
  EXPECT_FALSE(GetParam().seeds.empty());
  for (const std::string& seed : GetParam().seeds) EXPECT_TRUE(folder.reads(seed)) << seed;
}

TEST_P(Readers, ReadOrRefuseBrokenFiles) {
  FuzzFolder folder(GetParam());
  std::mt19937 random(7);
  int refused = 0;
  for (const std::string& seed : GetParam().seeds)
    for (int k = 0; k < 300; ++k) refused += !folder.reads(broken(seed, random));
  // content_hash takes any bytes.
  EXPECT_TRUE(refused > 10 || GetParam().name == "content_hash") << refused;
}

TEST_P(Readers, ReadOrRefuseWhatTheFuzzerFound) {
  FuzzFolder folder(GetParam());
  if (!fs::is_directory(corpus / GetParam().name)) GTEST_SKIP() << "no corpus of this reader";
  for (const auto& entry : fs::directory_iterator(corpus / GetParam().name)) {
    SCOPED_TRACE(entry.path().string());
    std::ifstream in(entry.path(), std::ios::binary);
    EXPECT_NO_THROW(folder.reads({std::istreambuf_iterator<char>(in), {}}));
  }
}

INSTANTIATE_TEST_SUITE_P(All, Readers, testing::ValuesIn(fuzz_readers()), [](const auto& reader) {
  std::string name = reader.param.name;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
});

TEST(Corpus, EveryFolderIsOfAReader) {
  for (const auto& entry : fs::directory_iterator(corpus))
    EXPECT_NO_THROW(fuzz_reader(entry.path().filename().string()));
}

}  // namespace
}  // namespace genio::test
