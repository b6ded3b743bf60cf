// Every dissipation obeys the same laws: the viscous force is minus its derivative by the
// velocities, damping minus the force's, symmetric; slopes and parameter derivatives are exact.

#include "tests/forward/effects/battery.hpp"

namespace genio {
namespace {

class DissipationLaw : public test::TermLaw<Dissipation> {
 protected:
  DissipationLaw() : TermLaw(&Model::dissipations) {}

  Forces viscous_at(const Positions& at, const Vector& v) const {
    Forces f = Forces::Zero(at.size());
    term->add_viscous_force(at, v, values, f);
    return f;
  }
  Forces viscous_at(const Vector& v) const { return viscous_at(x, v); }
};

TEST_P(DissipationLaw, ViscousForceIsMinusTheDissipationsDerivative) {
  const double exact = -viscous_at(velocity).dot(direction);
  ASSERT_NE(exact, 0.0);
  EXPECT_GT(-viscous_at(velocity).dot(velocity), 0);
  test::expect_v(test::errors_over_steps([&](double h) {
                   h *= 1e2;
                   const double quotient =
                       (term->dissipation(x, velocity + h * direction, values) -
                        term->dissipation(x, velocity - h * direction, values)) /
                       (2 * h);
                   return std::abs(quotient - exact) / std::abs(exact);
                 }),
                 1e-6);
}

TEST_P(DissipationLaw, DampingIsMinusTheViscousForcesDerivativeAndSymmetric) {
  Stiffness c(model.pattern);
  term->add_damping(x, velocity, values, c);
  expect_stiffness(c, [&](double h) { return viscous_at(velocity + h * direction); });
}

TEST_P(DissipationLaw, ViscousSlopeIsTheViscousForcesDerivative) {
  Matrix slope = Matrix::Zero(x.size(), 1);
  Stiffness scratch(model.pattern);
  term->add_viscous_force_slope(x, velocity, values, direction, scratch, slope);
  const double scale = slope.norm();
  const bool constant = viscous_at(x + 0.1 * direction, velocity) == viscous_at(velocity);
  if (constant) {
    EXPECT_EQ(scale, 0);
    return;
  }
  ASSERT_GT(scale, 0);
  test::expect_v(test::errors_over_steps([&](double h) {
                   return ((viscous_at(x + h * direction, velocity) -
                            viscous_at(x - h * direction, velocity)) /
                               (2 * h) -
                           slope)
                              .norm() /
                          scale;
                 }),
                 1e-6);
}

TEST_P(DissipationLaw, ViscousParameterDerivativesAreExact) {
  expect_parameter_derivatives(
      [&](int k, Forces& df) { term->add_viscous_force_derivative(x, velocity, values, k, df); },
      [&](const std::vector<double>& at, Forces& f) {
        term->add_viscous_force(x, velocity, at, f);
      });
}

TEST_P(DissipationLaw, VanishesAtItsAbsentParameters) {
  values = absent_values();
  EXPECT_EQ(term->dissipation(x, velocity, values), 0.0);
  EXPECT_EQ(viscous_at(velocity).norm(), 0.0);
}

INSTANTIATE_TEST_SUITE_P(Battery, DissipationLaw,
                         testing::ValuesIn(test::names_with(
                             build_model(test::with_every_effect(), "block").dissipations)),
                         [](const auto& parameter) { return parameter.param; });

}  // namespace
}  // namespace genio
