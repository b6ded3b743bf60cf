#include "forward/model/model_file.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "forward/model/build_model.hpp"
#include "tests/forward/small_model.hpp"

namespace genio {
namespace {

namespace fs = std::filesystem;

/// A copy of the small model on disk whose files a test may spoil.
class ModelFile : public testing::Test {
 protected:
  void SetUp() override {
    folder = fs::temp_directory_path() / ("genio_model_" + std::to_string(::getpid()));
    write_description(test::small_block(), folder.string());
  }
  void TearDown() override { fs::remove_all(folder); }
  void replace(const std::string& file, const std::string& from, const std::string& to) const {
    std::ifstream in(folder / file);
    std::stringstream text;
    text << in.rdbuf();
    std::string s = text.str();
    const auto at = s.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    s.replace(at, from.size(), to);
    std::ofstream(folder / file) << s;
  }
  std::string error() const {
    try {
      read_model(folder.string());
    } catch (const InputError& e) {
      return e.what();
    }
    return "";
  }
  fs::path folder;
};

void expect_says(const std::string& message, std::initializer_list<const char*> words) {
  for (const char* word : words) EXPECT_NE(message.find(word), std::string::npos) << message;
  EXPECT_EQ(message.find('\n'), std::string::npos);
}

TEST_F(ModelFile, ReadsWhatWasWritten) {
  EXPECT_EQ(error(), "");
  const auto d = read_description(folder.string());
  EXPECT_EQ(d.mesh.elements, test::small_block().mesh.elements);
  EXPECT_EQ(d.muscles[1].fibres[1][0].node, -1);
}

TEST_F(ModelFile, MissingFileIsNamed) {
  fs::remove(folder / "mesh.vtu");
  expect_says(error(), {"mesh.vtu", "no such file"});
}

TEST_F(ModelFile, SyntaxErrorHasItsLine) {
  replace("model.toml", "name = \"block\"", "name = block");
  expect_says(error(), {"model.toml:3"});
}

TEST_F(ModelFile, UnknownEffectSuggestsTheNearest) {
  replace("model.toml", "[effect.gravity]", "[effect.gravty]");
  expect_says(error(), {"gravty", "did you mean gravity"});
}

TEST_F(ModelFile, UnknownParameterSuggestsTheNearest) {
  replace("model.toml", "a10 =", "a1O =");
  expect_says(error(), {"a1O", "did you mean a10"});
}

TEST_F(ModelFile, NotANumberIsRefused) {
  replace("model.toml", "a10 = 192", "a10 = nan");
  expect_says(error(), {"model.toml:", "a10", "finite"});
}

TEST_F(ModelFile, WrongSupportIsNamed) {
  replace("mesh.vtu", "Name=\"support\"", "Name=\"suport\"");
  expect_says(error(), {"mesh.vtu", "'support' is missing"});
}

TEST(ModelCommands, UnknownOrTooStrongIsRefused) {
  const Model m = test::small_model();
  Parameters p = default_parameters(m);
  EXPECT_THROW(set_command(m, "GPG", 1, p), InputError);
  EXPECT_THROW(set_command(m, "GGP", 5, p), InputError);
  EXPECT_THROW(set_command(m, "GGP", -1, p), InputError);
  set_command(m, "GGP", 2, p);
  EXPECT_EQ(p[parameter_index(m, "muscles.GGP_L")], 1);
}

}  // namespace
}  // namespace genio
