// What the files of the Grenoble tongue may not say.

#include "forward/anatomy/grenoble_files.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

namespace genio::grenoble {
namespace {

class GrenobleFiles : public testing::Test {
 protected:
  ~GrenobleFiles() override { std::filesystem::remove(path); }
  /// What the reader says of a file that holds `text`, behind its name.
  template <class Read>
  std::string error(const std::string& text, const Read& read) {
    std::ofstream(path) << text;
    try {
      read();
    } catch (const InputError& e) {
      return std::string(e.what()).substr(path.string().size());
    }
    return "";
  }
  std::string fibres(const std::string& text) {
    return error(text, [&] {
      muscles.assign(2, Muscle{});
      read_fibres(path, 900, muscles);
    });
  }
  std::string selections(const std::string& text) {
    return error(text, [&] { elements = read_muscle_elements(path, 740); });
  }
  std::vector<Muscle> muscles;
  std::map<std::string, std::vector<int>> elements;
  const std::filesystem::path path =
      std::filesystem::temp_directory_path() / ("genio-grenoble-" + std::to_string(getpid()));
};

TEST_F(GrenobleFiles, FibresAreCountedFromOne) {
  EXPECT_EQ(fibres("FIBER(1,1,1) = 7\nFIBER(2,1,1) = 4037\n"), "");
  EXPECT_EQ(muscles[0].fibres[0][1].node, -1);
  const std::string order = "fibres and their points must be in order, from 1";
  EXPECT_EQ(fibres("FIBER(1,0,1) = 7\n"), ":1: point 1 of fibre 0: " + order);
  EXPECT_EQ(fibres("FIBER(0,1,1) = 7\n"), ":1: point 0 of fibre 1: " + order);
  EXPECT_EQ(fibres("FIBER(1,3,1) = 7\n"), ":1: point 1 of fibre 3: " + order);
  EXPECT_EQ(fibres("FIBER(1,1,0) = 7\n"), ":1: muscle 0 does not exist");
  EXPECT_EQ(fibres("FIBER(1,1,3) = 7\n"), ":1: muscle 3 does not exist");
}

TEST_F(GrenobleFiles, NumbersBeyondAnyMeshAreNamed) {
  const std::string huge = "99999999999999999999";
  const std::string none = "'" + huge + "' is no number that a mesh can need";
  EXPECT_EQ(fibres("FIBER(1,1,1) = " + huge + "\n"), ":1: " + none);
  EXPECT_EQ(fibres("FIBER(" + huge + ",1,1) = 7\n"), ":1: " + none);
  EXPECT_EQ(selections("\nESEL,S,ELEM,,1,7," + huge + "\n"), ":2: " + none);
}

TEST_F(GrenobleFiles, AHugeStepSelectsTheFirst) {
  EXPECT_EQ(selections("ESEL,S,ELEM,,3,740,2147483647\nCM,A,ELEM\n"), "");
  EXPECT_EQ(elements["A"], std::vector<int>{2});
  EXPECT_EQ(selections("ESEL,S,ELEM,,1,740,0\n"),
            ":1: element numbers must lie in 1 to 740, and their step above 0");
}

TEST_F(GrenobleFiles, LongLinesAreRefused) {
  EXPECT_EQ(fibres(std::string(1 << 20, ' ')), ":1: the line is longer than 1000 characters");
}

TEST_F(GrenobleFiles, EmptyMeshesAreRefused) {
  EXPECT_EQ(error("\n", [&] { read_mesh(path, path); }), ": has no node");
  EXPECT_EQ(error("0\n", [&] { read_list(path, 0); }),
            ":1: '0'; expected a node number from 0 to -1");
}

}  // namespace
}  // namespace genio::grenoble
