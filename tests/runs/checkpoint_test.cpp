#include "runs/results/checkpoint.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "forward/base/text_file.hpp"
#include "tests/runs/temporary_folder.hpp"

namespace genio {
namespace {

TEST(Checkpoints, OneIsReadBackAsWritten) {
  const test::TemporaryFolder folder;
  const std::vector<Vector> unknowns = {Vector{{1.0 / 3, -2e-300}}, Vector{{0, 1e17}}};
  Checkpoint(folder.path(), false).keep(unknowns);
  const Checkpoint again(folder.path(), true);
  ASSERT_EQ(again.known().size(), 2u);
  for (size_t k = 0; k < 2; ++k) EXPECT_EQ(again.known()[k], unknowns[k]);
}

TEST(Checkpoints, TheLastOneCounts) {
  const test::TemporaryFolder folder;
  const Checkpoint checkpoint(folder.path(), false);
  for (double value : {1., 2.}) checkpoint.keep({Vector{{value}}});
  EXPECT_EQ(Checkpoint(folder.path(), true).known().front()[0], 2);
  EXPECT_FALSE(std::filesystem::exists(folder.path() + "/checkpoint.json.new"));
}

TEST(Checkpoints, ARunThatDoesNotResumeStartsAfresh) {
  const test::TemporaryFolder folder;
  Checkpoint(folder.path(), false).keep({Vector{{1.}}});
  EXPECT_TRUE(Checkpoint(folder.path(), false).known().empty());
}

TEST(Checkpoints, WithoutAFolderNothingIsKept) {
  const Checkpoint checkpoint("", true);
  checkpoint.keep({Vector{{1.}}});
  EXPECT_TRUE(checkpoint.known().empty());
}

TEST(Checkpoints, ADamagedFileIsAnErrorOfTheInput) {
  const test::TemporaryFolder folder;
  for (const char* text : {"", "{\"unknowns\":[[\"x\"]]}", "{\"unknowns\":[[1", "{}"}) {
    write_text(folder.path() + "/checkpoint.json", text);
    EXPECT_THROW(Checkpoint(folder.path(), true), InputError) << text;
  }
}

}  // namespace
}  // namespace genio
