// Every potential obeys the same laws: force is minus the energy's derivative, stiffness minus the
// force's, symmetric; internal effects do not feel rigid motion; parameter derivatives are exact.

#include <Eigen/Geometry>

#include "forward/effects/newton_aid.hpp"
#include "tests/forward/effects/battery.hpp"

namespace genio {
namespace {

class PotentialLaw : public test::TermLaw<Potential> {
 protected:
  PotentialLaw() : TermLaw(&Model::potentials) {}

  Forces force_at(const Positions& at) const {
    Forces f = Forces::Zero(at.size());
    term->add_force(at, values, f);
    return f;
  }
};

TEST_P(PotentialLaw, ForceIsMinusTheEnergysDerivative) {
  const double exact = -force_at(x).dot(direction);
  ASSERT_NE(exact, 0.0);
  test::expect_v(test::errors_over_steps([&](double h) {
                   const double quotient = (term->energy(x + h * direction, values) -
                                            term->energy(x - h * direction, values)) /
                                           (2 * h);
                   return std::abs(quotient - exact) / std::abs(exact);
                 }),
                 1e-6);
}

TEST_P(PotentialLaw, StiffnessIsMinusTheForcesDerivativeAndSymmetric) {
  Stiffness k(model.pattern);
  term->add_stiffness(x, values, k);
  const bool constant = force_at(x + direction) == force_at(x);  // a dead load
  if (constant) EXPECT_EQ(k.multiply(direction).norm(), 0.0);
  else expect_stiffness(k, [&](double h) { return force_at(x + h * direction); });
}

TEST_P(PotentialLaw, StepStiffnessEqualsStiffnessWithoutAStep) {
  const NewtonAid* aid = term->newton_aid();
  if (!aid) return;
  Stiffness exact(model.pattern), step(model.pattern);
  term->add_stiffness(x, values, exact);
  const Bulk here = bulk(model, x, default_parameters(model));
  const Vector dilatation = here.excess.cwiseQuotient(here.volume);
  aid->add_step_stiffness(x, {x, Vector::Zero(x.size()), dilatation}, values, step);
  EXPECT_LE((exact.multiply(direction) - step.multiply(direction)).norm(),
            1e-12 * exact.multiply(direction).norm());
}

TEST_P(PotentialLaw, ParameterDerivativesAreExact) {
  expect_parameter_derivatives(
      [&](int k, Forces& df) { term->add_force_derivative(x, values, k, df); },
      [&](const std::vector<double>& at, Forces& f) { term->add_force(x, at, f); });
}

TEST_P(PotentialLaw, VanishesAtItsAbsentParameters) {
  if (kind.support) return;  // supports are there whatever their parameters
  values = absent_values();
  EXPECT_EQ(term->energy(x, values), 0.0);
  EXPECT_EQ(force_at(x).norm(), 0.0);
}

TEST_P(PotentialLaw, InternalForcesBalanceAndIgnoreRigidMotion) {
  if (kind.external) return;
  set_command(model, "GGP_R", 0, p);  // its anchor outside
  values = term.values(p);
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
  EXPECT_NEAR(term->energy(y, values), term->energy(x, values),
              1e-11 * std::abs(term->energy(x, values)));
  const Forces turned = force_at(y);
  for (Eigen::Index a = 0; a < x.size() / 3; ++a)
    EXPECT_LE((turned.segment<3>(3 * a) - r * f.segment<3>(3 * a)).norm(), 1e-10 * f.norm());
}

INSTANTIATE_TEST_SUITE_P(
    Battery, PotentialLaw,
    testing::ValuesIn(test::names_with(build_model(test::with_every_effect(), "block").potentials)),
    [](const auto& parameter) { return parameter.param; });

}  // namespace
}  // namespace genio
