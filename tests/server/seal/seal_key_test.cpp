#include "server/seal/seal_key.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <iterator>

#include "forward/base/types.hpp"
#include "tests/runs/temporary_folder.hpp"

namespace genio {
namespace {

class KeyFiles : public testing::Test {
 protected:
  void write_key(const std::string& text, mode_t mode = 0600) const {
    std::ofstream(path, std::ios::binary) << text;
    chmod(path.c_str(), mode);
  }
  std::string text() const {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  /// What is said of the file; empty where it is read.
  std::string refusal() const {
    try {
      read_key_file(path);
      return "";
    } catch (const InputError& e) {
      return e.what();
    }
  }
  void expect_refusal(const std::string& why) const {
    const std::string told = refusal();
    EXPECT_EQ(told.find(path + ": "), 0u) << told;
    EXPECT_NE(told.find(why), std::string::npos) << told << "; expected " << why;
  }
  test::TemporaryFolder folder;
  const std::string path = folder.path() + "/genio.key";
  const std::string digits = std::string(32, '0') + std::string(16, 'a') + std::string(16, 'F');
};

TEST_F(KeyFiles, ANewOneIsRandomPrivateAndRead) {
  const mode_t mask = umask(0);
  make_key_file(path);
  umask(mask);
  struct stat status {};
  ASSERT_EQ(stat(path.c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 07777, 0600u);
  const std::string first = text();
  EXPECT_EQ(first.size(), 65u);
  EXPECT_EQ(refusal(), "");
  unlink(path.c_str());
  make_key_file(path);
  EXPECT_NE(text(), first);
}

TEST_F(KeyFiles, OneThatIsThereIsNotWrittenOver) {
  write_key("mine");
  EXPECT_THROW(make_key_file(path), InputError);
  EXPECT_EQ(text(), "mine");
  EXPECT_THROW(make_key_file(folder.path() + "/nowhere/key"), InputError);
}

TEST_F(KeyFiles, DigitsAreTheKey) {
  for (const std::string end : {"", "\n"}) {
    write_key(digits + end, end.empty() ? 0400 : 0600);
    const SharedKey key = read_key_file(path);
    ASSERT_TRUE(key);
    const auto secret = key->secret();
    EXPECT_TRUE(std::all_of(secret.begin(), secret.begin() + 16, [](int b) { return b == 0; }));
    EXPECT_EQ(secret[16], 0xaa);
    EXPECT_EQ(secret[31], 0xff);
  }
}

TEST_F(KeyFiles, OneThatOthersMayReadOrWriteIsRefused) {
  for (const mode_t mode : {0640, 0604, 0620, 0602, 0610, 0601, 0644, 0666, 0777}) {
    write_key(digits, mode);
    expect_refusal("others");
  }
}

TEST_F(KeyFiles, OneOfAnotherUserIsRefused) {
  if (geteuid() != 0) GTEST_SKIP() << "only root can give a file away";
  write_key(digits);
  ASSERT_EQ(chown(path.c_str(), 12345, gid_t(-1)), 0);
  expect_refusal("belongs to another user");
}

TEST_F(KeyFiles, OneThatHoldsAnythingElseIsRefused) {
  expect_refusal("No such file");
  for (const std::string& wrong :
       {std::string(), std::string("\n"), digits.substr(1), digits.substr(1) + "\n",
        "g" + digits.substr(1), " " + digits.substr(1), digits.substr(0, 63) + std::string(1, '\0'),
        digits.substr(0, 62) + "\r\n", digits.substr(0, 32) + "\n" + digits.substr(33)}) {
    write_key(wrong);
    expect_refusal("expected one line of 64 hexadecimal digits");
  }
  for (const std::string& wrong : {digits + "0", digits + " ", digits + "\r\n", digits + "\n\n",
                                   digits + "\n" + digits, std::string(1 << 20, '0')}) {
    write_key(wrong);
    expect_refusal("is too long");
  }
}

TEST_F(KeyFiles, AFolderAndAPipeAreNoKeys) {
  ASSERT_EQ(mkfifo(path.c_str(), 0600), 0);
  expect_refusal("is no file");  // and nobody waits for its other end
  unlink(path.c_str());
  ASSERT_EQ(mkdir(path.c_str(), 0700), 0);
  expect_refusal("is no file");
}

}  // namespace
}  // namespace genio
