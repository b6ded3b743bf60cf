// What effects are made of, and what single ones do.

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <set>
#include <stdexcept>

#include "forward/effects/surroundings/gravity.hpp"
#include "forward/model/build_model.hpp"
#include "forward/model/effect_kinds.hpp"
#include "forward/model/sums.hpp"
#include "tests/forward/small_model.hpp"

namespace genio {
namespace {

TEST(Battery, CoversEveryEffectOfTheSmallModel) {
  const Model m = build_model(test::with_every_effect(), "block");
  EXPECT_EQ(m.effects.size(), effect_kinds().size());
  std::set<int> covered;  // by a law of its terms
  for (const auto& e : m.potentials) covered.insert(e.effect);
  for (const auto& d : m.dissipations) covered.insert(d.effect);
  for (const auto& i : m.inertias) covered.insert(i.effect);
  for (const auto& f : m.filters) covered.insert(f.effect);
  for (const auto& a : m.anatomy) covered.insert(a.effect);
  EXPECT_EQ(covered.size(), m.effects.size());
}

TEST(Battery, AnEffectsParametersAreThoseOfItsTermsInTheirOrder) {
  const Model m = build_model(test::with_every_effect(), "block");
  const auto names = [&](const char* effect) {
    std::vector<std::string> result;
    for (const ParameterInfo& info : find_effect(m, effect)->parameters())
      result.push_back(info.name);
    return result;
  };
  EXPECT_EQ(names("palate_contact"), (std::vector<std::string>{"stiffness", "damping"}));
  EXPECT_EQ(names("hyoid_mobility"),
            (std::vector<std::string>{"compliance_z", "stiffness_xy", "mass"}));
  EXPECT_EQ(names("activation_dynamics"), (std::vector<std::string>{"rise", "fall"}));
}

TEST(Battery, AnEffectNeedsATerm) { EXPECT_THROW(Effect{}.name(), std::logic_error); }

TEST(Battery, BeliefsAreOfParametersThatTheirEffectsHave) {
  const Model m = build_model(test::with_every_effect(), "block");
  for (const EffectKind& kind : effect_kinds()) {
    const auto parameters = find_effect(m, kind.name)->parameters();
    for (const ParameterBelief& belief : kind.belief.parameters) {
      EXPECT_GT(belief.typical, 0) << kind.name;
      EXPECT_TRUE(belief.parameter.empty() ||
                  std::any_of(parameters.begin(), parameters.end(),
                              [&](const auto& info) { return info.name == belief.parameter; }))
          << kind.name << "." << belief.parameter;
    }
    for (const Variant& variant : variants_of(kind.belief, parameters))
      for (const auto& number : variant.numbers)
        for (int k : number) EXPECT_LT(size_t(k), parameters.size()) << kind.name;
  }
}

TEST(Battery, HiddenChangesAreOfTheirEffectAndGrow) {
  const ModelDescription tongue = read_description(test::generic_model());
  const std::vector<std::string> active = {"GGP", "HG", "STY", "TRANS"};
  for (const EffectKind& kind : effect_kinds()) {
    if (!kind.hidden) continue;
    std::mt19937 random(3), again(3);
    const EffectChange change = kind.hidden({tongue, active, true, random});
    EXPECT_EQ(change.effect, kind.name);
    EXPECT_LE(change.first, change.most) << kind.name;
    const ModelDescription with = change.truth(tongue, change.first),
                           without = change.shipped(tongue, change.first);
    EXPECT_TRUE(with.effects.contains(kind.name));
    EXPECT_NE(with.effects, without.effects) << kind.name;
    EXPECT_NO_THROW(build_model(with, kind.name)) << kind.name;
    const EffectChange same = kind.hidden({tongue, active, true, again});
    EXPECT_EQ(change.parameters(1), same.parameters(1)) << kind.name;
    EXPECT_EQ(random(), again()) << kind.name;
  }
}

TEST(JointForces, AreTheForcesOfPotentialAndDissipationOneByOne) {
  const Model m = build_model(test::with_every_effect(), "block");
  Parameters p = default_parameters(m);
  set_command(m, "GGP_L", 0.2, p);
  const Positions x = test::shaken(m, 4e-4, 3);
  const Vector v = 20 * (test::shaken(m, 4e-3, 17) - m.rest);
  Forces viscous, one_by_one = Forces::Zero(x.size());
  const Forces f = forces_in_motion(m, x, v, p, viscous);
  for (const auto& d : m.dissipations) d->add_viscous_force(x, v, d.values(p), one_by_one);
  EXPECT_LE((f - force(m, x, p)).norm(), 1e-12 * f.norm());
  EXPECT_LE((viscous - one_by_one).norm(), 1e-12 * viscous.norm());
}

TEST(Inertia, AddsItsMassOnceInAll) {
  const Model m = build_model(test::with_every_effect(), "block");
  ASSERT_EQ(m.inertias.size(), 1u);
  Parameters p = default_parameters(m);
  p[parameter_index(m, "hyoid_mobility.mass")] = 0.03;
  Vector mass = Vector::Zero(Eigen::Index(m.mesh.nodes.size()));
  m.inertias[0]->add_mass(m.inertias[0].values(p), mass);
  EXPECT_NEAR(mass.sum(), 0.03, 1e-15);
  EXPECT_GE(mass.minCoeff(), 0);
}

TEST(CommandFilter, FollowsUpAndDownByItsOwnTimeConstants) {
  const Model m = build_model(test::with_every_effect(), "block");
  ASSERT_EQ(m.filters.size(), 1u);
  const auto& filter = m.filters[0];
  const double p[] = {0.01, 0.04};
  EXPECT_NEAR(filter->follow(1, 0, 0.01, p), 1 - std::exp(-1), 1e-12);
  EXPECT_NEAR(filter->follow(0, 1, 0.04, p), std::exp(-1), 1e-12);
  EXPECT_EQ(filter->memory(p), 0.04);
  const double none[] = {0, 0};
  EXPECT_EQ(filter->follow(0.7, 0.1, 1e-3, none), 0.7);
}

TEST(Muscles, PullFadesSmoothlyWhereASegmentCollapses) {
  const Model m = test::small_model();
  const auto& muscles = find_effect(m, "muscles")->potential;
  const auto& segment = m.muscles[0].segments.front();
  ASSERT_GE(segment.end.node, 0);
  std::vector<double> tension(m.muscles.size(), 0.0);
  tension[0] = 1;
  const Vec3 d = segment.end.position(m.rest) - segment.start.position(m.rest);
  for (const double part : {0.0, 0.02, 0.1, 0.19999, 0.2, 0.20001, 0.3}) {
    Positions x = m.rest;
    x.segment<3>(3 * segment.end.node) = segment.start.position(m.rest) + part * d;
    Vector direction = test::shaken(m, 1.0, 5) - m.rest;
    const double h = 1e-7 / direction.norm();
    const auto force_at = [&](double s) {
      Forces f = Forces::Zero(x.size());
      muscles->add_force(x + s * direction, tension, f);
      return f;
    };
    const auto energy_at = [&](double s) { return muscles->energy(x + s * direction, tension); };
    EXPECT_NEAR((energy_at(h) - energy_at(-h)) / (2 * h), -force_at(0).dot(direction),
                1e-4 * direction.norm())
        << part;
    Stiffness k(m.pattern);
    muscles->add_stiffness(x, tension, k);
    const Vector exact = k.multiply(direction);
    EXPECT_LT(((force_at(-h) - force_at(h)) / (2 * h) - exact).norm(), 1e-3 * exact.norm()) << part;
  }
}

TEST(Elasticity, EnergyIsInfiniteForInvertedTissue) {
  const Model m = test::small_model();
  Positions x = m.rest;
  x[3 * 30 + 2] -= 0.03;
  EXPECT_TRUE(std::isinf(energy(m, x, default_parameters(m))));
}

TEST(Gravity, PullsWithTheWholeWeight) {
  const Model m = test::small_model();
  const Gravity g(tissue_mass(m.mesh, 1000), Vec3(0, 0, -10));
  Forces f = Forces::Zero(m.rest.size());
  const double p[] = {0, 0, -10, 0};
  g.add_force(m.rest, p, f);
  double sum = 0;
  for (Eigen::Index i = 2; i < f.size(); i += 3) sum += f[i];
  EXPECT_NEAR(sum, -1e4 * mesh_volume(m.mesh, m.rest), 1e-12);
}

}  // namespace
}  // namespace genio
