// Every effect obeys the same laws: force is minus the energy's derivative, stiffness minus the
// force's, symmetric; internal effects do not feel rigid motion; parameter derivatives are exact.
// A difference quotient's error falls with the step, then rises with rounding: a V.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <functional>

#include "forward/effects/surroundings/gravity.hpp"
#include "forward/model/build_effects.hpp"
#include "forward/model/build_model.hpp"
#include "tests/forward/small_model.hpp"

namespace genio {
namespace {

/// Relative errors of central differences for steps 1e-3 ... 1e-9.
template <class Error>
std::vector<double> errors_over_steps(Error error) {
  std::vector<double> e;
  for (double h = 1e-3; h > 5e-10; h /= 10) e.push_back(error(h));
  return e;
}

void expect_v(const std::vector<double>& e, double bottom) {
  const double best = *std::min_element(e.begin(), e.end());
  EXPECT_LT(best, bottom);
  // Falls before and rises after, unless the function is linear or quadratic and rounding is all.
  if (e.front() > 1e-7) {
    EXPECT_LT(e[1], 0.2 * e.front());
  }
  EXPECT_GT(e.back(), best);
}

/// Effects whose forces depend on velocity only, or that have none.
bool without_energy(const std::string& name) {
  return name == "viscosity" || name == "force_velocity" || name == "activation_dynamics";
}

class EffectLaw : public testing::TestWithParam<std::string> {
 protected:
  EffectLaw()
      : model(build_model(test::with_every_effect(), "block")),
        effect(find_effect(model, GetParam())),
        p(default_parameters(model)) {
    set_command(model, "GGP_L", 0.2, p);
    set_command(model, "GGP_R", 0.1, p);
    values = values_at(p);
    x = test::shaken(model, 4e-4, 3);
    for (int a = 0; a < int(model.mesh.nodes.size()); ++a) {
      x[3 * a + 2] += 1.6e-3;  // some touch
      if (model.mesh.nodes[size_t(a)][0] < 2e-3) x[3 * a] -= 1.4e-3;
    }
    direction = test::shaken(model, 1.0, 11) - model.rest;
    direction *= 3e-2 / direction.norm();
    velocity = 20 * (test::shaken(model, 4e-3, 17) - model.rest);
  }
  std::vector<double> values_at(const Parameters& at) const {
    for (size_t e = 0; e < model.effects.size(); ++e)
      if (model.effects[e].get() == effect) return effect_parameters(model, at, int(e));
    return {};
  }
  Forces force_at(const Positions& at) const {
    Forces f = Forces::Zero(at.size());
    effect->add_force(at, values, f);
    return f;
  }
  Forces viscous_at(const Vector& v) const {
    Forces f = Forces::Zero(v.size());
    effect->add_viscous_force(x, v, values, f);
    return f;
  }
  void expect_stiffness(const Stiffness& k, const std::function<Forces(double)>& force) const {
    const Vector exact = k.multiply(direction);
    const double scale = exact.norm();
    ASSERT_GT(scale, 0);
    expect_v(errors_over_steps([&](double h) {
               return ((force(-h) - force(h)) / (2 * h) - exact).norm() / scale;
             }),
             1e-6);
    const Vector other = test::shaken(model, 1.0, 23) - model.rest;
    EXPECT_NEAR(other.dot(exact), direction.dot(k.multiply(other)), 1e-12 * scale * other.norm());
  }
  /// d force / d parameter k against differences, for every own and borrowed parameter.
  template <class Derivative, class Force>
  void expect_parameter_derivatives(Derivative derivative, Force force) {
    for (size_t k = 0; k < values.size(); ++k) {
      Forces exact = Forces::Zero(x.size());
      derivative(int(k), exact);
      std::vector<double> up = values, down = values;
      const double h = values[k] != 0 ? 1e-4 * std::abs(values[k]) : 1e-6;
      up[k] += h, down[k] -= h;
      Forces plus = Forces::Zero(x.size()), minus = plus;
      force(up, plus);
      force(down, minus);
      EXPECT_LE(((plus - minus) / (2 * h) - exact).norm(), 1e-6 * std::max(exact.norm(), 1e-9))
          << "parameter " << k;
    }
  }

  Model model;
  const Effect* effect;
  Parameters p;
  std::vector<double> values;
  Positions x;
  Vector direction, velocity;
};

TEST_P(EffectLaw, ViscousSlopeIsTheViscousForcesDerivative) {
  const auto at = [&](const Positions& y) {
    Forces f = Forces::Zero(y.size());
    effect->add_viscous_force(y, velocity, values, f);
    return f;
  };
  Matrix slope = Matrix::Zero(x.size(), 1);
  Stiffness scratch(model.pattern);
  effect->add_viscous_force_slope(x, velocity, values, direction, scratch, slope);
  const double scale = slope.norm();
  if (at(x).isZero(0) || GetParam() == "viscosity") {
    EXPECT_EQ(scale, 0);
    return;
  }
  ASSERT_GT(scale, 0);
  expect_v(errors_over_steps([&](double h) {
             return ((at(x + h * direction) - at(x - h * direction)) / (2 * h) - slope).norm() /
                    scale;
           }),
           1e-6);
}

TEST_P(EffectLaw, ForceIsMinusTheEnergysDerivative) {
  const double exact = -force_at(x).dot(direction);
  if (without_energy(GetParam())) {
    EXPECT_EQ(exact, 0.0);
    EXPECT_EQ(effect->energy(x, values), 0.0);
    return;
  }
  ASSERT_NE(exact, 0.0);
  expect_v(errors_over_steps([&](double h) {
             const double quotient = (effect->energy(x + h * direction, values) -
                                      effect->energy(x - h * direction, values)) /
                                     (2 * h);
             return std::abs(quotient - exact) / std::abs(exact);
           }),
           1e-6);
}

TEST_P(EffectLaw, StiffnessIsMinusTheForcesDerivativeAndSymmetric) {
  Stiffness k(model.pattern);
  effect->add_stiffness(x, values, k);
  if (GetParam() == "gravity" || without_energy(GetParam()))
    EXPECT_EQ(k.multiply(direction).norm(), 0.0);
  else expect_stiffness(k, [&](double h) { return force_at(x + h * direction); });
}

TEST_P(EffectLaw, StepStiffnessEqualsStiffnessWithoutAStep) {
  Stiffness exact(model.pattern), step(model.pattern);
  effect->add_stiffness(x, values, exact);
  const Bulk here = bulk(model, x, default_parameters(model));
  const Vector dilatation = here.excess.cwiseQuotient(here.volume);
  effect->add_step_stiffness(x, {x, Vector::Zero(x.size()), dilatation}, values, step);
  EXPECT_LE((exact.multiply(direction) - step.multiply(direction)).norm(),
            1e-12 * exact.multiply(direction).norm());
}

TEST_P(EffectLaw, ParameterDerivativesAreExact) {
  expect_parameter_derivatives(
      [&](int k, Forces& df) { effect->add_force_derivative(x, values, k, df); },
      [&](const std::vector<double>& at, Forces& f) { effect->add_force(x, at, f); });
}

TEST_P(EffectLaw, ViscousForceIsMinusTheDissipationsDerivative) {
  const double exact = -viscous_at(velocity).dot(direction);
  if (exact == 0) {  // no dissipation at all
    EXPECT_EQ(effect->dissipation(x, velocity, values), 0.0);
    return;
  }
  EXPECT_GT(-viscous_at(velocity).dot(velocity), 0);
  expect_v(errors_over_steps([&](double h) {
             h *= 1e2;
             const double quotient = (effect->dissipation(x, velocity + h * direction, values) -
                                      effect->dissipation(x, velocity - h * direction, values)) /
                                     (2 * h);
             return std::abs(quotient - exact) / std::abs(exact);
           }),
           1e-6);
}

TEST_P(EffectLaw, DampingIsMinusTheViscousForcesDerivativeAndSymmetric) {
  if (viscous_at(velocity).norm() == 0) return;
  Stiffness c(model.pattern);
  effect->add_damping(x, velocity, values, c);
  expect_stiffness(c, [&](double h) { return viscous_at(velocity + h * direction); });
}

TEST_P(EffectLaw, ViscousParameterDerivativesAreExact) {
  expect_parameter_derivatives(
      [&](int k, Forces& df) { effect->add_viscous_force_derivative(x, velocity, values, k, df); },
      [&](const std::vector<double>& at, Forces& f) {
        effect->add_viscous_force(x, velocity, at, f);
      });
}

TEST_P(EffectLaw, VanishesAtItsAbsentParameters) {
  // Supports are there whatever their parameters.
  if (GetParam() == "jaw_opening" || GetParam() == "hyoid_mobility") return;
  const auto own = effect->parameters();
  for (size_t k = 0; k < own.size(); ++k) values[k] = own[k].absent;
  EXPECT_EQ(effect->energy(x, values), 0.0);
  EXPECT_EQ(force_at(x).norm(), 0.0);
  EXPECT_EQ(viscous_at(velocity).norm(), 0.0);
}

TEST_P(EffectLaw, InternalForcesBalanceAndIgnoreRigidMotion) {
  for (const char* outer : {"gravity", "palate_contact", "jaw_contact", "jaw_opening",
                            "hyoid_mobility", "airway_pressure"})
    if (GetParam() == outer) return;  // these act from outside
  set_command(model, "GGP_R", 0, p);  // its anchor outside
  values = values_at(p);
  const Forces f = force_at(x);
  Vec3 sum = Vec3::Zero(), moment = Vec3::Zero();
  for (Eigen::Index a = 0; a < x.size() / 3; ++a) {
    sum += f.segment<3>(3 * a);
    moment += Vec3(x.segment<3>(3 * a)).cross(Vec3(f.segment<3>(3 * a)));
  }
  EXPECT_LE(sum.norm(), 1e-12 * f.norm());
  EXPECT_LE(moment.norm(), 1e-12 * f.norm());
  const Mat3 r = Eigen::AngleAxisd(0.9, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  Positions y(x.size());
  for (Eigen::Index a = 0; a < x.size() / 3; ++a)
    y.segment<3>(3 * a) = r * x.segment<3>(3 * a) + Vec3(0.1, -0.2, 0.3);
  EXPECT_NEAR(effect->energy(y, values), effect->energy(x, values),
              1e-11 * std::abs(effect->energy(x, values)));
  const Forces turned = force_at(y);
  for (Eigen::Index a = 0; a < x.size() / 3; ++a)
    EXPECT_LE((turned.segment<3>(3 * a) - r * f.segment<3>(3 * a)).norm(), 1e-10 * f.norm());
}

INSTANTIATE_TEST_SUITE_P(Battery, EffectLaw, testing::ValuesIn(effect_names()),
                         [](const auto& parameter) { return parameter.param; });

TEST(Battery, CoversEveryEffectOfTheSmallModel) {
  const Model m = build_model(test::with_every_effect(), "block");
  EXPECT_EQ(m.effects.size(), effect_names().size());
}

TEST(Muscles, PullFadesSmoothlyWhereASegmentCollapses) {
  const Model m = test::small_model();
  const auto* muscles = find_effect(m, "muscles");
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
