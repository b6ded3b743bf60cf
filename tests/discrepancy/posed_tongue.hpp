#pragma once
#include <gtest/gtest.h>

#include "discrepancy/conditions/influence.hpp"
#include "discrepancy/contest/discover.hpp"
#include "forward/model/build_model.hpp"
#include "forward/model/hypothesis.hpp"
#include "tests/forward/small_model.hpp"

namespace genio::test {

/// The generic tongue in a few postures under known forces, seen without noise from the same mesh.
class PosedTongue : public testing::Test {
 protected:
  using Posture = std::map<std::string, double>;

  Condition posed(const ModelDescription& truth, const Posture& forces, bool known) {
    const Model m = build_model(truth, "truth");
    Workspace ws(m);
    Parameters p = default_parameters(m);
    for (const auto& [name, f] : forces) set_command(m, name, f, p);
    const auto e = solve_equilibrium(m, p, m.rest, ws);
    EXPECT_TRUE(e) << e.message;
    Condition c;
    c.target = curve_target(m, e.x, 30, noise);
    if (!known) return c;
    c.forces.emplace();
    for (const auto& [name, f] : forces)
      for (int k : command_parameters(m, name))
        (*c.forces)[m.parameters[size_t(k)].info.name] = {p[k], 0.05 * p[k]};
    return c;
  }
  Observations observed(const ModelDescription& truth, bool known) {
    Observations o;
    o.noise = noise, o.noise_correlation = 8e-3;
    for (const Posture& forces : postures) {
      o.conditions.push_back(posed(truth, forces, known));
      o.conditions.back().name = std::to_string(o.conditions.size());
    }
    return o;
  }

  const double noise = 4e-4;
  const std::vector<Posture> postures = {
      {{"GGP", 3}, {"TRANS", 2}}, {{"STY", 2}, {"SL", 1}}, {{"HG", 3}, {"GGA", 1}}};
  const ModelDescription tongue = read_description(generic_model());
};

/// A description fitted to what was seen of a truth.
class FittedTongue : public PosedTongue {
 protected:
  void fit_to(const ModelDescription& truth, const ModelDescription& description) {
    observations = observed(truth, true);
    set =
        std::make_unique<ConditionSet>(description, observations, fitted_conditions(observations));
    f = fit(*set, {}, nullptr);
    ASSERT_TRUE(f.converged) << f.message;
    influences = influences_of(*set, f);
  }
  Observations observations;
  std::unique_ptr<ConditionSet> set;
  JointFit f;
  std::vector<Matrix> influences;
};

}  // namespace genio::test
