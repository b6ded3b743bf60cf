// Modes of anatomy are parameters like any other: their laws are those of a model built by hand.

#include "forward/effects/modes/anatomy_modes.hpp"

#include <Eigen/Geometry>
#include <thread>

#include "forward/effects/muscles/muscles.hpp"
#include "forward/model/at_anatomy.hpp"
#include "forward/statics/sensitivity.hpp"
#include "tests/forward/effects/battery.hpp"

namespace genio {
namespace {

const double near_one = 0.4, below = -0.7;  // [sd]

/// The small block with every effect, at an anatomy that is not the file's.
class AnatomyModesLaw : public testing::Test {
 protected:
  AnatomyModesLaw() : model(build_model(test::with_every_effect(), "block")) {
    p = default_parameters(model);
    set_parameter(model, "anatomy.size", near_one, p);
    set_parameter(model, "anatomy.depth", below, p);
    set_command(model, "GGP_L", 0.2, p);
    set_command(model, "GGP_R", 0.1, p);
    const auto here = at_anatomy(model, p);
    x = here->rest + test::shaken(model, 2e-4, 3) - model.rest;
    for (int a = 0; a < int(model.mesh.nodes.size()); ++a) {
      x[3 * a + 2] += 1.6e-3;  // some touch
      if (model.mesh.nodes[size_t(a)][0] < 2e-3) x[3 * a] -= 1.2e-3;
    }
    direction = test::shaken(model, 1.0, 11) - model.rest;
    direction *= 3e-2 / direction.norm();
  }

  const Model model;
  Parameters p;
  Positions x;
  Vector direction;
};

TEST_F(AnatomyModesLaw, EveryEffectActsInTheShapeThatIsTested) {
  const auto here = at_anatomy(model, p);
  ASSERT_NE(here.get(), &model);
  for (const auto& e : here->potentials) EXPECT_NE(e->energy(x, e.values(p)), 0) << e->name();
}

TEST_F(AnatomyModesLaw, ForceIsMinusTheEnergysDerivative) {
  const double exact = -force(model, x, p).dot(direction);
  test::expect_v(test::errors_over_steps([&](double h) {
                   const double quotient =
                       (energy(model, x + h * direction, p) - energy(model, x - h * direction, p)) /
                       (2 * h);
                   return std::abs(quotient - exact) / std::abs(exact);
                 }),
                 1e-6);
}

TEST_F(AnatomyModesLaw, StiffnessIsMinusTheForcesDerivative) {
  Stiffness k(model.pattern);
  stiffness(model, x, p, k);
  const Vector exact = k.multiply(direction);
  test::expect_v(
      test::errors_over_steps([&](double h) {
        return ((force(model, x - h * direction, p) - force(model, x + h * direction, p)) /
                    (2 * h) -
                exact)
                   .norm() /
               exact.norm();
      }),
      1e-6);
}

/// The derivative by each mode at x against central differences, a V over the step.
void expect_derivatives(const Model& model, const Positions& x, const Parameters& p,
                        double bottom) {
  for (const char* name : {"anatomy.size", "anatomy.depth"}) {
    const int k[] = {parameter_index(model, name)};
    const Vector exact = force_derivatives(model, x, p, k).col(0);
    const Vector held = held_motion(model, k).col(0);
    const auto force_at = [&](double h) {
      Parameters q = p;
      q[k[0]] += h;
      return force(model, x + h * held, q);
    };
    const auto errors = test::errors_over_steps([&](double h) {
      h *= 30;
      return ((force_at(h) - force_at(-h)) / (2 * h) - exact).norm() / exact.norm();
    });
    test::expect_v(errors, bottom);
  }
}

TEST_F(AnatomyModesLaw, ForceDerivativesAreThoseOfDifferences) {
  expect_derivatives(model, x, p, 1e-5);  // distances to bones are kept in single precision
}

TEST_F(AnatomyModesLaw, ForceDerivativesAwayFromBonesAreExactToADifferencesRounding) {
  ModelDescription d = test::with_every_effect();
  d.effects.erase("palate_contact"), d.effects.erase("jaw_contact");
  const Model free = build_model(d, "block");
  Parameters q = default_parameters(free);
  for (size_t k = 0; k < free.parameters.size(); ++k)
    q[Eigen::Index(k)] = p[parameter_index(model, free.parameters[k].name)];
  expect_derivatives(free, x, q, 3e-8);
}

TEST_F(AnatomyModesLaw, ZeroIsTheModelItself) {
  Parameters none = p;
  for (const char* name : {"anatomy.size", "anatomy.depth"}) none[parameter_index(model, name)] = 0;
  EXPECT_EQ(at_anatomy(model, none).get(), &model);
  EXPECT_EQ(at_anatomy(model).get(), &model);
  // What is moved by next to nothing is next to it.
  Parameters tiny = none;
  tiny[parameter_index(model, "anatomy.size")] = 1e-9;
  EXPECT_NEAR(energy(model, x, tiny), energy(model, x, none), 1e-6 * energy(model, x, none));
}

TEST_F(AnatomyModesLaw, AnImpossibleAnatomyHasNoEnergyAndNoEquilibrium) {
  ModelDescription d = test::small_block();
  d = with_modes(d, {{"fold", [](const Vec3& at) -> Vec3 { return {-0.6 * at[0], 0, 0}; }}});
  const Model m = build_model(d, "block");
  Parameters q = default_parameters(m);
  q[parameter_index(m, "anatomy.fold")] = 2;
  EXPECT_TRUE(std::isinf(energy(m, m.rest, q)));
  Workspace ws(m);
  const Equilibrium e = solve_equilibrium(m, q, m.rest, ws);
  EXPECT_FALSE(e);
  EXPECT_FALSE(e.message.empty());
}

/// A block with a bone above, gravity and muscles, and its modes.
ModelDescription moded_block() {
  ModelDescription d = with_modes(test::small_block(), test::test_modes());
  d.effects["elasticity"] = {{"a10", 500}, {"a20", 200}, {"kappa", 5e4}};
  return d;
}

Equilibrium solved(const Model& m, const Parameters& p) {
  Workspace ws(m);
  const Equilibrium e = solve_equilibrium(m, p, m.rest, ws, {.tolerance = 1e-12});
  EXPECT_TRUE(e) << e.message;
  return e;
}

Parameters pulled(const Model& m, double size, double depth) {
  Parameters p = default_parameters(m);
  set_parameter(m, "anatomy.size", size, p);
  set_parameter(m, "anatomy.depth", depth, p);
  set_command(m, "GGP_L", 0.02, p);
  set_command(m, "GGP_R", 0.01, p);
  return p;
}

TEST(AnatomyModes, EquilibriumIsThatOfAModelBuiltByHand) {
  const Model m = build_model(moded_block(), "block");
  const Parameters p = pulled(m, 0.8, -1.1);
  const Equilibrium e = solved(m, p);
  ModelDescription d = moved(moded_block(), std::vector{0.8, -1.1});
  d.modes.clear(), d.effects.erase("anatomy");
  // Fibres share their force as the standing tongue's do.
  ModelParts parts = build_model(d, "by hand").parts();
  for (size_t k = 0; k < parts.muscles.size(); ++k)
    for (size_t s = 0; s < parts.muscles[k].segments.size(); ++s)
      parts.muscles[k].segments[s].share = m.muscles[k].segments[s].share;
  for (Effect& effect : parts.effects)
    if (effect.commands) effect = muscle_commands(parts.muscles);
  const Model by_hand(std::move(parts));
  Parameters q = default_parameters(by_hand);
  set_command(by_hand, "GGP_L", 0.02, q);
  set_command(by_hand, "GGP_R", 0.01, q);
  const Equilibrium other = solved(by_hand, q);
  EXPECT_GT((e.x - at_anatomy(m, p)->rest).cwiseAbs().maxCoeff(), 1e-4);
  EXPECT_LT((e.x - other.x).cwiseAbs().maxCoeff(), 1e-10);
}

TEST(AnatomyModes, SensitivityIsThatOfEquilibriaSolvedAgain) {
  const Model m = build_model(moded_block(), "block");
  const Parameters p = pulled(m, 0.8, -1.1);
  const Equilibrium e = solved(m, p);
  Workspace ws(m);
  const int which[] = {parameter_index(m, "anatomy.size"), parameter_index(m, "anatomy.depth")};
  const Matrix exact = sensitivity(m, e, which, ws);
  for (int c = 0; c < 2; ++c) {
    const double h = 1e-3;
    Parameters up = p, down = p;
    up[which[c]] += h, down[which[c]] -= h;
    const Vector quotient = (solved(m, up).x - solved(m, down).x) / (2 * h);
    EXPECT_LT((quotient - exact.col(c)).norm(), 1e-5 * quotient.norm());
  }
}

TEST(AnatomyModes, ForceOfATongueOnItsBonesIsDifferentiatedToo) {
  ModelDescription d = read_description(test::generic_model());
  const auto plain = plain_modes(d);
  const Model m = build_model(with_modes(std::move(d), plain), "generic");
  for (const auto& forces : {std::vector<std::pair<const char*, double>>{{"GGP", 3}, {"TRANS", 2}},
                             {{"GGP", 14}, {"STY", 8}}}) {  // meets the palate
    Parameters p = default_parameters(m);
    for (const auto& [name, newtons] : forces) set_command(m, name, newtons, p);
    const Equilibrium e = solved(m, p);
    EXPECT_GT(m.contacts.front()->max_penetration(e.x, m.contacts.front().values(p)) +
                  m.contacts.back()->max_penetration(e.x, m.contacts.back().values(p)),
              0);
    for (const char* mode : {"anatomy.size", "anatomy.pharynx"}) {
      const int k[] = {parameter_index(m, mode)};
      const Vector exact = force_derivatives(m, e.x, p, k).col(0);
      const Vector held = held_motion(m, k).col(0);
      const auto force_at = [&](double s) {
        Parameters q = p;
        q[k[0]] += s;
        return force(m, e.x + s * held, q);
      };
      const double h = 1e-4;
      EXPECT_LT(((force_at(h) - force_at(-h)) / (2 * h) - exact).norm(), 3e-5 * exact.norm());
    }
  }
}

TEST(AnatomyModes, StartsOfAnotherAnatomyLeadToTheSameShape) {
  const Model m = build_model(moded_block(), "block");
  const Equilibrium there = solved(m, pulled(m, -2.5, 1.5));
  const Parameters p = pulled(m, 2.5, -1.5);
  const Equilibrium cold = solved(m, p);
  Workspace ws(m);
  const Equilibrium warm = solve_equilibrium(m, p, there.x, ws, {.tolerance = 1e-12});
  ASSERT_TRUE(warm) << warm.message;
  EXPECT_LT((warm.x - cold.x).cwiseAbs().maxCoeff(), 1e-10);
  const Positions moved_start = carried(m, at_anatomy(m, pulled(m, -2.5, 1.5))->rest, p);
  EXPECT_LT((moved_start - at_anatomy(m, p)->rest).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(AnatomyModes, AScaledTongueUnderForcesTimesItsSquareIsTheScaledShape) {
  // Stresses stay, so that forces go with the square of lengths.
  ModelDescription d = test::small_block();
  d.effects.erase("gravity"), d.effects.erase("palate_contact");
  d.effects["elasticity"] = {{"a10", 500}, {"a20", 200}, {"kappa", 5e4}};
  d = with_modes(d, {{"size", [](const Vec3& x) -> Vec3 { return 0.1 * x; }}});
  const Model m = build_model(d, "block");
  Parameters p = default_parameters(m);
  set_command(m, "GGP_L", 0.02, p);
  set_command(m, "GGP_R", 0.01, p);
  const Equilibrium one = solved(m, p);
  const double scale = 1.2;
  set_parameter(m, "anatomy.size", 2, p);
  set_command(m, "GGP_L", 0.02 * scale * scale, p);
  set_command(m, "GGP_R", 0.01 * scale * scale, p);
  const Equilibrium two = solved(m, p);
  EXPECT_GT((one.x - m.rest).cwiseAbs().maxCoeff(), 3e-4);
  EXPECT_LT((two.x - scale * one.x).cwiseAbs().maxCoeff(), 1e-10);
}

TEST(AnatomyModes, ATurnedHeadIsTheSameTongue) {
  const Mat3 turn = Eigen::AngleAxisd(0.3, Vec3(0, 1, 0)).toRotationMatrix();
  const Vec3 shift(0.01, 0, -0.02);
  ModelDescription d = test::small_block();
  d.effects.erase("gravity"), d.effects.erase("palate_contact");
  d = with_modes(d, {{"turn", [&](const Vec3& x) -> Vec3 { return turn * x + shift - x; }}});
  const Model m = build_model(d, "block");
  Parameters p = default_parameters(m);
  set_command(m, "GGP_L", 0.2, p);
  set_command(m, "GGP_R", 0.1, p);
  const Positions x = test::shaken(m, 4e-4, 3);
  Positions turned(x.size());
  for (Eigen::Index a = 0; a < x.size() / 3; ++a)
    turned.segment<3>(3 * a) = turn * x.segment<3>(3 * a) + shift;
  const double before = energy(m, x, p);
  const Forces f = force(m, x, p);
  set_parameter(m, "anatomy.turn", 1, p);
  EXPECT_NEAR(energy(m, turned, p), before, 1e-11 * std::abs(before));
  const Forces g = force(m, turned, p);
  for (Eigen::Index a = 0; a < x.size() / 3; ++a)
    EXPECT_LT((g.segment<3>(3 * a) - turn * f.segment<3>(3 * a)).norm(), 1e-10 * f.norm());
}

TEST(AnatomyModes, AnyNumberOfThreadsMayAskForShapes) {
  const Model m = build_model(moded_block(), "block");
  std::vector<double> alone, together(16);
  const auto ask = [&](int i) {
    Parameters p = default_parameters(m);
    p[parameter_index(m, "anatomy.size")] = 0.1 * (i % 8);
    return energy(m, at_anatomy(m, p)->rest + test::shaken(m, 2e-4, 5) - m.rest, p);
  };
  for (int i = 0; i < 16; ++i) alone.push_back(ask(i));
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t)
    threads.emplace_back([&, t] {
      for (int i = t; i < 16; i += 4) together[size_t(i)] = ask(i);
    });
  for (std::thread& t : threads) t.join();
  EXPECT_EQ(alone, together);
}

}  // namespace
}  // namespace genio
