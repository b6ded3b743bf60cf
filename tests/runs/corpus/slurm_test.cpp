#include "runs/corpus/slurm.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "forward/base/types.hpp"
#include "runs/process/program.hpp"
#include "tests/runs/temporary_folder.hpp"

namespace genio {
namespace {

TEST(SlurmArray, NamesTasksByRanges) {
  EXPECT_EQ(array_ranges({0, 1, 2, 3}), "0-3");
  EXPECT_EQ(array_ranges({2, 4, 5, 9}), "2,4-5,9");
  EXPECT_EQ(array_ranges({7}), "7");
}

TEST(SlurmArray, ScriptsHoldTheOptionsAndAreSound) {
  const test::TemporaryFolder folder;
  const std::string out = folder.path() + "/it's 100%";
  write_scripts({"/opt/genio", out, {0, 1, 3}, 2, {"--partition=long"}});
  std::ifstream in(out + "/slurm/tasks.sh");
  const std::string text(std::istreambuf_iterator<char>(in), {});
  EXPECT_NE(text.find("#SBATCH --array=0-1,3%2\n"), std::string::npos) << text;
  EXPECT_NE(text.find("#SBATCH --partition=long\n"), std::string::npos);
  EXPECT_NE(text.find("#SBATCH --requeue\n"), std::string::npos);
  EXPECT_NE(text.find("100%%/slurm/task_%a.log"), std::string::npos);
  for (const char* script : {"tasks.sh", "merge.sh"})
    EXPECT_EQ(run_program({"sh", "-n", out + "/slurm/" + script}).status, 0) << script;
}

TEST(SlurmArray, OptionsThatAreTheCorpussOwnAreRefused) {
  EXPECT_NO_THROW(check_sbatch_options({"--partition=long", "-p", "--mem=2G"}));
  for (const char* option : {"--array=1-3", "-d", "--wrap", "partition", "--x\n#SBATCH -a 1"})
    EXPECT_THROW(check_sbatch_options({option}), InputError) << option;
}

TEST(Program, TellsItsStatusAndWhatItSaid) {
  const ProgramEnd end = run_program({"sh", "-c", "echo out; echo err >&2; exit 3"});
  EXPECT_EQ(end.status, 3);
  EXPECT_EQ(end.said, "out\nerr\n");
  EXPECT_EQ(run_program({"sh", "-c", "kill -9 $$"}).status, 137);
  EXPECT_THROW(run_program({"no-such-program-here"}), InputError);
}

}  // namespace
}  // namespace genio
