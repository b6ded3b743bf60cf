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

TEST(TextFile, ReplacingLeavesTheNewTextAlone) {
  const std::string path =
      (std::filesystem::temp_directory_path() / ("genio-text-" + std::to_string(getpid())))
          .string();
  write_text(path, "old, and longer than the new\n");
  replace_text(path, "new\n");
  EXPECT_EQ(text_of(path), "new\n");
  EXPECT_FALSE(std::filesystem::exists(path + ".new"));
  std::filesystem::remove(path);
}

TEST(TextFile, OneThatCannotBeWrittenIsAnErrorThatNamesIt) {
  for (const auto write : {write_text, replace_text}) try {
      write("/no/such/folder/file", "text");
      FAIL() << "written into no folder";
    } catch (const InputError& e) {
      EXPECT_NE(std::string(e.what()).find("/no/such/folder/file"), std::string::npos) << e.what();
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
