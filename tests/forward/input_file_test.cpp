// Files that others wrote are looked at before they are opened.

#include "forward/base/input_file.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "forward/base/toml_depth.hpp"
#include "forward/base/types.hpp"

namespace genio {
namespace {

class InputFiles : public testing::Test {
 protected:
  InputFiles() { std::filesystem::create_directory(folder); }
  ~InputFiles() override { std::filesystem::remove_all(folder); }
  static std::string error(const std::string& file, std::uintmax_t largest = largest_input) {
    try {
      read_file(file, largest);
    } catch (const InputError& e) {
      return e.what();
    }
    return "";
  }
  const std::string folder =
      (std::filesystem::temp_directory_path() / ("genio-input-" + std::to_string(getpid())))
          .string();
  const std::string path = folder + "/file";
};

TEST_F(InputFiles, AreReadWhole) {
  const std::string text("a\0\r\nb", 5);
  std::ofstream(path, std::ios::binary) << text;
  EXPECT_EQ(read_file(path), text);
  std::ofstream(path, std::ios::binary) << std::string(300000, 'x');
  EXPECT_EQ(read_file(path), std::string(300000, 'x'));
}

TEST_F(InputFiles, AreNoFoldersAndNoDevices) {
  EXPECT_EQ(error(folder), folder + ": is a folder; expected a file");
  EXPECT_EQ(error("/dev/zero"), "/dev/zero: is a pipe or a device; expected a file on a disk");
  EXPECT_EQ(error(path), path + ": no such file");
  EXPECT_NE(error(std::string("a\0b", 3)).find("NUL"), std::string::npos);
  EXPECT_NE(error(folder + "/" + std::string(5000, 'a')).find("cannot be read"), std::string::npos);
}

TEST_F(InputFiles, APipeIsNotWaitedFor) {
  ASSERT_EQ(mkfifo(path.c_str(), 0600), 0);
  EXPECT_EQ(error(path), path + ": is a pipe or a device; expected a file on a disk");
}

TEST_F(InputFiles, AreRefusedWhereTheyAreTooLarge) {
  std::ofstream(path).close();
  std::filesystem::resize_file(path, (4 << 20) + 1);  // takes no room on the disk
  EXPECT_EQ(error(path, largest_settings), path + ": is larger than 4 MB; expected a smaller file");
  EXPECT_EQ(error(path), "");
}

TEST(TomlKeys, OfHundredsOfPartsAreFound) {
  const auto key = [](int parts, const std::string& part) {
    std::string text = "x = 1\n[a";
    for (int k = 1; k < parts; ++k) text += part;
    return text + "]\n";
  };
  EXPECT_FALSE(keys_too_deep(key(100, ".a")));
  EXPECT_TRUE(keys_too_deep(key(1000, ".a")));
  EXPECT_TRUE(keys_too_deep(key(1000, " . \"a\"")));
  std::string numbers = "a = [0.1";
  for (int k = 0; k < 1000; ++k) numbers += ", 0.1";
  EXPECT_FALSE(keys_too_deep(numbers + "]"));
  EXPECT_FALSE(keys_too_deep("# " + std::string(1000, '.')));
}

}  // namespace
}  // namespace genio
