// A model is assembled once; a changed one is a new value, and workspaces know whose they are.

#include "forward/model/model.hpp"

#include <gtest/gtest.h>

#include "forward/effects/surroundings/dead_load.hpp"
#include "forward/statics/equilibrium.hpp"
#include "forward/statics/sensitivity.hpp"
#include "tests/forward/small_model.hpp"

namespace genio {
namespace {

TEST(ParameterNames, AreReadBackAsTheyAreWritten) {
  const ParameterName name = ParameterName::parse("gravity.z");
  EXPECT_EQ(name.effect, "gravity");
  EXPECT_EQ(name.key, "z");
  EXPECT_EQ(ParameterName::parse(name.text()), name);
  for (const char* broken : {"", "gravity", ".z", "gravity."})
    EXPECT_THROW(ParameterName::parse(broken), InputError) << broken;
}

TEST(Models, AChangedModelIsANewOneAndLeavesTheFirstAsItWas) {
  const Model first = test::small_model();
  const size_t effects = first.effects.size(), parameters = first.parameters.size();
  ModelParts parts = first.parts();
  parts.effects.push_back(
      {.potential = std::make_shared<DeadLoad>("load", Forces::Ones(first.rest.size()), 0.1)});
  const Model second(std::move(parts));
  EXPECT_EQ(first.effects.size(), effects);
  EXPECT_EQ(first.parameters.size(), parameters);
  EXPECT_EQ(second.parameters.size(), parameters + 1);
  EXPECT_EQ(second.parameters.back().name, (ParameterName{"load", "force"}));
  EXPECT_THROW(parameter_index(first, "load.force"), InputError);
}

TEST(Models, AnEffectThatBorrowsWhatNobodyHasIsRefused) {
  const Model whole = build_model(test::with_every_effect(), "block");
  ModelParts parts = whole.parts();
  std::erase_if(parts.effects, [](const auto& e) { return e.name() == "jaw_opening"; });
  EXPECT_THROW(Model(std::move(parts)), InputError);
}

TEST(Workspaces, ServeTheirModelItsCopiesAndNoOther) {
  const Model first = test::small_model(), copy = first, other(first.parts());
  Workspace ws(first);
  const Parameters p = default_parameters(first);
  EXPECT_TRUE(solve_equilibrium(first, p, first.rest, ws));
  EXPECT_TRUE(solve_equilibrium(copy, p, first.rest, ws));
  EXPECT_THROW(solve_equilibrium(other, p, first.rest, ws), std::invalid_argument);
  const Equilibrium e = solve_equilibrium(first, p, first.rest, ws);
  EXPECT_THROW(sensitivity(other, e, std::vector{0}, ws), std::invalid_argument);
}

TEST(Workspaces, OutliveTheirModel) {
  std::optional<Model> model(test::small_model());
  Workspace ws(*model);
  const Model copy = *model;
  // Its factor and the bulk that belongs to it stay in the workspace.
  ASSERT_TRUE(solve_equilibrium(*model, default_parameters(*model), model->rest, ws));
  model.reset();
  EXPECT_TRUE(solve_equilibrium(copy, default_parameters(copy), copy.rest, ws));
}

}  // namespace
}  // namespace genio
