#include "forward/algebra/mixed_solver.hpp"

#include <gtest/gtest.h>

#include "bench/problems/block.hpp"
#include "forward/statics/equilibrium.hpp"

namespace genio {
namespace {

/// A block at two equilibria some millimetres apart, with the factor of the first.
struct TwoShapes {
  Model model = bench::block(1);
  Parameters p = default_parameters(model), more = p;
  Workspace ws{model};
  Positions first, second;

  TwoShapes() {
    const int load = parameter_index(model, "load.force");
    p[load] = 0.5, more[load] = 0.6;
    first = solve_equilibrium(model, p, model.rest, ws).x;
    second = solve_equilibrium(model, more, first, ws).x;
    stiffness(model, first, p, ws.stiffness);
    ws.factorize(model, first, p);
    stiffness(model, second, more, ws.stiffness);
  }
  MixedVector load() const {
    return {model.dofs.reduce(force(model, first, more)),
            Vector::Zero(Eigen::Index(model.mesh.elements.size()))};
  }
  bool solve(const MixedVector& right, double accuracy, int patience, MixedVector& step) {
    const auto product = [&](const Vector& v) -> Vector {
      return model.dofs.reduce(ws.stiffness.multiply(model.dofs.expand(v)));
    };
    return ws.mixed.solve(ws.cholesky, model.dofs, product, bulk(model, second, more), right,
                          accuracy, patience, step);
  }
};

TEST(VolumeGradients, AreTheDerivativesOfTheVolumes) {
  const TwoShapes t;
  const Bulk b = bulk(t.model, t.second, t.more);
  const Vector v = Vector::Random(t.second.size()) * 1e-3;
  const double h = 1e-3;
  const Vector quotient = (bulk(t.model, t.second + h * v, t.more).excess -
                           bulk(t.model, t.second - h * v, t.more).excess) /
                          (2 * h);
  EXPECT_LT((b.gradients.rates(v) - quotient).norm(), 1e-6 * quotient.norm());
  double whole = 0;
  for (int e = 0; e < int(t.model.mesh.elements.size()); ++e) {
    const double excess =
        element_volume(t.model.mesh, t.second, e) - element_volume(t.model.mesh, t.model.rest, e);
    EXPECT_NEAR(b.excess[e], excess, 1e-12 * b.volume[e]);
    whole += b.volume[e];
  }
  EXPECT_NEAR(whole, 60e-3 * 40e-3 * 50e-3, 1e-12);
}

TEST(VolumeGradients, ForcesAreTheTransposeOfRates) {
  const TwoShapes t;
  const VolumeGradients g(t.model.batches, t.second);
  const Vector v = Vector::Random(t.second.size()), q = Vector::Random(g.elements());
  Vector forces = Vector::Zero(t.second.size());
  g.add_times(q, forces);
  EXPECT_NEAR(forces.dot(v), q.dot(g.rates(v)), 1e-12 * forces.norm() * v.norm());
}

TEST(Cholesky, PreconditionsAsItSolvesButForSinglePrecision) {
  const TwoShapes t;
  for (int k = 0; k < 3; ++k) {
    const Vector b = Vector::Random(t.model.dofs.unknowns()), exact = t.ws.cholesky.solve(b);
    EXPECT_LT((t.ws.cholesky.precondition(b) - exact).norm(), 1e-4 * exact.norm());
    EXPECT_GT((t.ws.cholesky.precondition(b) - exact).norm(), 0);
  }
}

TEST(MixedSolver, NormIsThatOfTheFactorAtHand) {
  TwoShapes t;
  const MixedVector right = t.load();
  const auto norm = [&] { return t.ws.mixed.norm(t.ws.cholesky, right, t.model.dofs); };
  const double here = norm();
  EXPECT_NEAR(here, right.u.dot(t.ws.cholesky.solve(right.u)), 1e-4 * here);
  MixedVector step;
  ASSERT_TRUE(t.solve({2 * right.u, right.pressure}, 1e-3, 40, step));
  EXPECT_EQ(norm(), here) << "other solves in between change nothing";
  ASSERT_TRUE(t.ws.factorize(t.model, t.second, t.more));
  const double there = right.u.dot(t.ws.cholesky.solve(right.u));
  ASSERT_GT(std::abs(there - here), 1e-2 * here);
  EXPECT_NEAR(norm(), there, 1e-4 * there);
}

TEST(MixedSolver, AnswersAsAFreshFactorWould) {
  TwoShapes t;
  MixedVector step;
  const MixedVector right = t.load();
  ASSERT_TRUE(t.solve(right, 1e-7, 40, step));
  ASSERT_TRUE(t.ws.factorize(t.model, t.second, t.more));
  const Vector exact = t.ws.cholesky.solve(right.u);
  EXPECT_LT((step.u - exact).norm(), 1e-5 * exact.norm());  // the factor is in single precision
}

TEST(MixedSolver, TakesFewIterationsOnTheFactorOfAnotherShape) {
  TwoShapes t;
  ASSERT_GT((t.second - t.first).cwiseAbs().maxCoeff(), 4e-3);  // that is far
  MixedVector step;
  EXPECT_TRUE(t.solve(t.load(), 1e-3, 12, step));
  EXPECT_FALSE(t.solve(t.load(), 1e-9, 3, step)) << "an unfinished solve must not pass for one";
}

TEST(MixedSolver, IsExactOnItsOwnShapeWithVolumeErrorsToo) {
  TwoShapes t;
  stiffness(t.model, t.second, t.more, t.ws.stiffness);
  ASSERT_TRUE(t.ws.factorize(t.model, t.second, t.more));
  MixedVector right = t.load();
  const Bulk b = bulk(t.model, t.second, t.more);
  right.pressure = 1e-3 * Vector::Random(b.volume.size()).cwiseProduct(b.volume);
  const MixedVector step = t.ws.mixed.step(t.ws.cholesky, right, t.model.dofs);
  // Both rows of the system.
  const Vector rates = b.gradients.rates(t.model.dofs.expand(step.u));
  Forces f = t.ws.stiffness.multiply(t.model.dofs.expand(step.u));
  b.gradients.add_times(step.pressure - b.stiffness.cwiseProduct(rates), f);
  EXPECT_LT((t.model.dofs.reduce(f) - right.u).norm(), 1e-8 * right.u.norm());
  EXPECT_LT((rates - step.pressure.cwiseQuotient(b.stiffness) - right.pressure).norm(),
            1e-9 * right.pressure.norm());
}

}  // namespace
}  // namespace genio
