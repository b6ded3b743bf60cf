#include "runs/frames/movement_run.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "forward/motion/commands_over_time.hpp"
#include "tests/forward/small_model.hpp"
#include "tests/runs/temporary_folder.hpp"

namespace genio {
namespace {

Estimate estimate(const std::string& name, double best, Unknown::Kind kind) {
  return {.name = name, .best = best, .unit = "N", .kind = kind};
}

// The force of a muscle that the model lacks is in newtons, too, and yet no muscle's command.
TEST(MovementRun, ItsCommandsAreReadBack) {
  const Model m = test::small_model();
  const std::string muscle = m.muscles.front().name;
  const auto slot = std::find_if(m.parameters.begin(), m.parameters.end(),
                                 [](const ParameterSlot& s) { return !s.is_command; });
  ASSERT_NE(slot, m.parameters.end());
  const double value = slot->info.value;
  MotionAnswer a;
  a.knots_s = {0, 0.1};
  for (const double force : {0.25, 0.5})
    a.estimates.push_back({estimate(muscle, force, Unknown::Kind::muscle),
                           estimate(slot->name.text(), value, Unknown::Kind::parameter)});
  const test::TemporaryFolder folder;
  const std::string path = folder.path() + "/commands.csv";
  std::ofstream(path) << commands_csv(a);
  const CommandsOverTime c = read_commands(m, path, default_parameters(m));
  ASSERT_EQ(c.times.size(), 2u);
  EXPECT_EQ(c.at(0.1)[command_parameters(m, muscle).front()], 0.5);
}

}  // namespace
}  // namespace genio
