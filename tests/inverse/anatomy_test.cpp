// Modes of anatomy are estimated along with forces.

#include <gtest/gtest.h>

#include "forward/effects/modes/anatomy_modes.hpp"
#include "forward/model/at_anatomy.hpp"
#include "inverse/shape/infer.hpp"
#include "inverse/shape/objective.hpp"
#include "inverse/target/comparison.hpp"
#include "tests/forward/small_model.hpp"

namespace genio {
namespace {

class EstimatedAnatomy : public testing::Test {
 protected:
  static ModelDescription moded() {
    ModelDescription d = read_description(test::generic_model());
    const auto plain = plain_modes(d);
    return with_modes(std::move(d), plain);
  }
  EstimatedAnatomy() {
    prior.parameters["anatomy.size"] = {{0, 1}};
    prior.parameters["anatomy.pharynx"] = {{0, 1}};
    p = default_parameters(m);
    set_command(m, "GGP", 3, p), set_command(m, "TRANS", 1, p);
    set_parameter(m, "anatomy.size", 0.8, p), set_parameter(m, "anatomy.pharynx", -0.6, p);
    const auto e = solve_equilibrium(m, p, m.rest, ws);
    EXPECT_TRUE(e) << e.message;
    target = curve_target(m, e.x, 40, 3e-4);
  }
  const Model m = build_model(moded(), "generic");
  Workspace ws{m};
  Prior prior;
  Parameters p;
  Target target;
};

TEST_F(EstimatedAnatomy, ComesWithTheForcesAndItsInterval) {
  const Answer a = infer(m, target, prior, ws);
  EXPECT_EQ(a.verdict, Verdict::explained);
  EXPECT_LT(a.rms, 3e-4);
  ASSERT_EQ(a.others.size(), 2u);
  for (const Estimate& e : a.others) {
    const double truth = p[parameter_index(m, e.name)];
    EXPECT_NEAR(e.best, truth, 3 * e.sd) << e.name;
    EXPECT_LT(e.low, e.high) << e.name;
    EXPECT_LT(e.sd, 0.7) << e.name;  // the data tell something
    EXPECT_EQ(e.unit, "sd");
  }
  for (const Estimate& e : a.muscles)
    if (e.name == "GGP") {
      EXPECT_NEAR(e.best, 3, std::max(3 * e.sd, 0.3));
    }
}

TEST_F(EstimatedAnatomy, GradientAndHessianOfTheMisfitCountTheModes) {
  Target near = curve_target(m, m.rest, 30, 1e-3);
  for (auto& point : near.curve) point.position += Vec2(1e-3, 2e-3);
  const Comparison comparison(m, near);
  const InferOptions options;
  Objective objective(m, comparison, prior, options, ws);
  const Vector z = Vector::Constant(Eigen::Index(objective.unknowns().size()), 0.03);
  const ObjectivePoint point = *objective.derivatives(z);
  const Matrix hessian = objective.exact_hessian(point);
  // Two muscles, then the modes.
  for (Eigen::Index k = z.size() - 4; k < z.size(); ++k) {
    const double h = 1e-4;
    const ObjectivePoint up = *objective.derivatives(z + h * Vector::Unit(z.size(), k)),
                         down = *objective.derivatives(z - h * Vector::Unit(z.size(), k));
    EXPECT_NEAR((up.value - down.value) / (2 * h), point.gradient[k],
                1e-4 * std::abs(point.gradient[k]));
    const Vector quotient = (up.gradient - down.gradient) / (2 * h);
    EXPECT_LT((quotient - hessian.col(k)).norm(), 5e-3 * quotient.norm())
        << objective.unknowns()[size_t(k)].name << ": " << quotient.transpose() << "\nagainst "
        << hessian.col(k).transpose();
  }
}

}  // namespace
}  // namespace genio
