#include "forward/base/text_file.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "forward/base/elapsed.hpp"
#include "forward/base/types.hpp"

namespace genio {
namespace {

std::string text_of(const std::string& path) {
  std::stringstream all;
  all << std::ifstream(path).rdbuf();
  return all.str();
}

class TextFiles : public testing::Test {
 protected:
  TextFiles() { std::filesystem::create_directory(folder); }
  ~TextFiles() override { std::filesystem::remove_all(folder); }
  const std::string folder =
      (std::filesystem::temp_directory_path() / ("genio-text-" + std::to_string(getpid())))
          .string();
  const std::string path = folder + "/file";
};

TEST_F(TextFiles, WritingLeavesTheNewTextAlone) {
  write_text(path, "old, and longer than the new\n");
  write_text(path, "new\n");
  EXPECT_EQ(text_of(path), "new\n");
  EXPECT_FALSE(std::filesystem::exists(path + ".new"));
}

TEST_F(TextFiles, AnInterruptedWriteLeavesTheOldTextAndNothingBeside) {
  write_text(path, "old\n");
  EXPECT_THROW(replace_file(path,
                            [](const std::string& file) {
                              std::ofstream(file) << "half";
                              throw InputError("interrupted");
                            }),
               InputError);
  EXPECT_EQ(text_of(path), "old\n");
  EXPECT_FALSE(std::filesystem::exists(path + ".new"));
}

TEST_F(TextFiles, AFullDiskIsAnErrorThatNamesFileAndReason) {
  std::filesystem::create_symlink("/dev/full", path);
  try {
    write_text(path, "text");
    FAIL() << "written where nothing fits";
  } catch (const InputError& e) {
    EXPECT_EQ(std::string(e.what()), path + ": cannot be written: No space left on device");
  }
}

TEST(TextFile, OneThatCannotBeWrittenIsAnErrorThatNamesIt) {
  try {
    write_text("/no/such/folder/file", "text");
    FAIL() << "written into no folder";
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("/no/such/folder/file"), std::string::npos) << e.what();
  }
}

TEST_F(TextFiles, AFolderThatCannotBeMadeIsAnErrorThatNamesIt) {
  write_text(path, "a file");
  try {
    make_folder(path + "/below");
    FAIL() << "made below a file";
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find(path + "/below"), std::string::npos) << e.what();
  }
}

TEST(Stopwatch, ItRunsForwards) {
  const Stopwatch watch;
  const double first = watch.seconds();
  usleep(2000);
  EXPECT_GE(first, 0);
  EXPECT_GE(watch.seconds(), first + 0.002);
}

}  // namespace
}  // namespace genio
