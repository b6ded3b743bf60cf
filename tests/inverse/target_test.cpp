#include "inverse/target/target.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>

#include "forward/model/mirror.hpp"
#include "inverse/shape/curvature.hpp"
#include "inverse/shape/infer.hpp"
#include "inverse/target/comparison.hpp"
#include "inverse/target/head_pose.hpp"
#include "inverse/target/tissue_point.hpp"
#include "tests/inverse/pulled_tongue.hpp"

namespace genio {
namespace {

class TargetTest : public test::PulledTongue {
 protected:
  /// One target of every kind, a little off the rest shape.
  Target mixed() const {
    Target t = curve_target(m, m.rest, 12, 1e-3);
    for (auto& p : t.curve) p.position += Vec2(4e-4, 7e-4);
    t.flesh.push_back({{{m.landmarks.tip, 1.0}},
                       node_position(m.rest, m.landmarks.tip) + Vec3(1e-3, 0, -1e-3),
                       1e-3,
                       "tip"});
    t.flesh.push_back(
        {tissue_point(m.mesh, inner()), inner() + Vec3(1e-3, 5e-4, 0), 2e-3, "volume"});
    for (const Quad& q : {m.surface[3], m.surface[40]}) {
      Vec3 middle = Vec3::Zero();
      for (int a : q) middle += 0.25 * node_position(m.rest, a);
      t.surface.push_back({middle + Vec3(3e-4, 2e-4, 5e-4), 1e-3});
    }
    return t;
  }
  Vec3 inner() const {
    Vec3 p = Vec3::Zero();
    for (int k = 0; k < 8; ++k)
      p += (0.05 + 0.02 * k) * m.mesh.nodes[size_t(m.mesh.elements[100][size_t(k)])];
    return p / (8 * 0.05 + 0.02 * 28);
  }
};

TEST_F(TargetTest, SmoothingEvensOutTheKinksBetweenFacesAndLittleElse) {
  // From one side of an edge of every quad to the other.
  std::vector<double> exact, smoothed;
  double off = 0;
  for (const Quad& q : m.surface) {
    const Vec3 a = node_position(m.rest, q[0]), b = node_position(m.rest, q[1]),
               c = node_position(m.rest, q[2]), d = node_position(m.rest, q[3]);
    const Vec3 centre = 0.25 * (a + b + c + d), normal = (c - a).cross(d - b).normalized();
    const Vec3 middle = 0.5 * (a + b);
    const auto seen = [&](const Vec3& at, double smoothing) {
      Target t;
      t.surface.push_back({at + 2e-4 * normal, 1e-3});
      return Comparison(m, t, smoothing)(m.rest);
    };
    const Vec3 across = 1e-4 * (centre - middle).normalized();
    const auto jump = [&](double smoothing) {
      const auto slope = [&](const Vec3& at) {
        Vec3 sum = Vec3::Zero();
        const Residuals r = seen(at, smoothing);
        for (const auto& [node, g] : r.gradient[0]) sum -= 1e-3 * g;
        return sum;
      };
      return (slope(middle + across) - slope(middle - across)).norm();
    };
    exact.push_back(jump(0)), smoothed.push_back(jump(1.5e-3));
    off = std::max(off, std::abs(seen(centre, 1.5e-3).values[0] - seen(centre, 0).values[0]));
  }
  // All but the sharpest twentieth: the rim and the tip.
  const auto most = [](std::vector<double> v) {
    std::sort(v.begin(), v.end());
    return v[v.size() * 19 / 20];
  };
  EXPECT_GT(most(exact), 0.2);
  EXPECT_LT(most(smoothed), 0.2 * most(exact));
  EXPECT_LT(1e-3 * off, 5e-4);  // where the tongue is bent most
}

TEST_F(TargetTest, DistancesFromAWarpedSurfaceAreTheSameInTheMirror) {
  ASSERT_TRUE(mirror_of(m));
  Positions x = m.rest;
  for (Eigen::Index a = 0; a < x.size() / 3; ++a) {
    const double s = std::sin(700 * x[3 * a] + 500 * std::abs(x[3 * a + 1]) + 900 * x[3 * a + 2]);
    x[3 * a + 2] += 1e-3 * s;
  }
  Target right, left;
  for (const Quad& q : m.surface) {
    Vec3 p = Vec3::Zero();
    const double share[] = {0.35, 0.25, 0.3, 0.1};
    for (size_t k = 0; k < 4; ++k) p += share[k] * node_position(x, q[k]);
    right.surface.push_back({p, 1e-3});
    left.surface.push_back({Vec3(p[0], -p[1], p[2]), 1e-3});
  }
  const Residuals r = Comparison(m, right)(x), l = Comparison(m, left)(x);
  EXPECT_GT(r.values.cwiseAbs().maxCoeff(), 0.01);  // warped
  EXPECT_LT((r.values - l.values).cwiseAbs().maxCoeff(), 1e-6);
}

TEST_F(TargetTest, ATissuePointIsWhereItWasTaken) {
  const auto shares = tissue_point(m.mesh, inner());
  double sum = 0;
  for (const auto& [node, share] : shares) sum += share;
  EXPECT_NEAR(sum, 1, 1e-12);
  EXPECT_LT((FleshPoint{shares, {}, 1, ""}.on(m.rest) - inner()).norm(), 1e-9);
  EXPECT_THROW(tissue_point(m.mesh, Vec3(0, 0, 0)), InputError);
}

TEST_F(TargetTest, ResidualsHaveTheirOwnDerivatives) {
  for (const auto& [dof, smoothing] : {std::pair(0.0, 0.0), {4.0, 0.0}, {0.0, 1.5e-3}}) {
    Target t = mixed();
    t.outlier_dof = dof;
    const Comparison compare(m, t, smoothing);
    const HeadPose pose{Vec2(5e-4, -3e-4), 0.02};
    const Residuals r = compare(m.rest, pose);
    const Vector d = 1e-3 * Vector::Random(m.rest.size());
    const double h = 1e-3;
    const Vector quotient =
        (compare(m.rest + h * d, pose).values - compare(m.rest - h * d, pose).values) / (2 * h);
    const Vector exact = residual_jacobian(r, d);
    // Surface points slide along their facet; their distance's derivative is exact all the same.
    EXPECT_LT((quotient - exact).norm(), 1e-4 * exact.norm()) << dof;
    for (int k = 0; k < 3; ++k) {
      const double e = k < 2 ? 1e-7 : 1e-5;
      HeadPose up = pose, down = pose;
      (k < 2 ? up.shift[k] : up.turn) += e;
      (k < 2 ? down.shift[k] : down.turn) -= e;
      const Vector q = (compare(m.rest, up).values - compare(m.rest, down).values) / (2 * e);
      EXPECT_LT((q - r.pose.col(k)).norm(), 1e-4 * q.norm()) << dof << " " << k;
    }
  }
}

TEST_F(TargetTest, CurvatureIsWhatGaussNewtonLeavesOut) {
  Target t = mixed();
  // Past an edge and past a corner of the surface.
  t.surface.push_back({node_position(m.rest, m.landmarks.tip) + Vec3(-4e-3, 1e-3, 0), 1e-3});
  // Past the end of the line, and of one that may be longer.
  for (const double longer : {0.0, 4e-3}) t.curve.push_back({Vec2(0.12, 0.055), 1e-3, longer});
  for (const double dof : {0.0, 4.0}) {
    t.outlier_dof = dof;
    const Comparison compare(m, t);
    const HeadPose pose{Vec2(5e-4, -3e-4), 0.02};
    const Residuals r = compare(m.rest, pose);
    Matrix along = Matrix::Random(m.rest.size(), 4), turn(3, 4);
    turn << 1, 0, 0, 0.3, 0, 1, 0, 0.2, 0, 0, 30, 10;
    const auto gradient = [&](const Vector& d) -> Vector {
      const Vec3 p = turn * d;
      const Residuals s = compare(m.rest + along * d, {pose.shift + p.head<2>(), pose.turn + p[2]});
      return (residual_jacobian(s, along) + s.pose * turn).transpose() * s.values;
    };
    const Matrix j = residual_jacobian(r, along) + r.pose * turn;
    const Matrix exact =
        target_curvature(compare, m.rest, pose, r, along, turn) + j.transpose() * j;
    const double h = 1e-7;
    for (Eigen::Index k = 0; k < 4; ++k) {
      const Vector d = h * Vector::Unit(4, k);
      const Vector quotient = (gradient(d) - gradient(-d)) / (2 * h);
      EXPECT_LT((quotient - exact.col(k)).norm(), 1e-4 * exact.col(k).norm()) << dof << " " << k;
    }
    EXPECT_GT((exact - j.transpose() * j).norm(), 1e-3 * exact.norm());
  }
}

TEST_F(TargetTest, ThePlaceThatMovedIsForgivenAndNotTheOneThatStayed) {
  Positions x = m.rest;
  const int tip = m.landmarks.tip;
  for (const int node : m.midsagittal)
    if ((m.mesh.nodes[size_t(node)] - m.mesh.nodes[size_t(tip)]).norm() < 0.02)
      x.segment<3>(3 * node) += Vec3(0, 0, 8e-3);
  Target t;
  t.flesh.push_back({{{tip, 1.0}}, Vec3::Zero(), 5e-4, "tip"});
  t.flesh.push_back({{{m.landmarks.root, 1.0}}, Vec3::Zero(), 5e-4, "root"});
  const Residuals r = Comparison(m, t)(x);
  const Vector ways = ways_from_rest(r, x, m.rest);
  EXPECT_NEAR(ways[0], 8e-3, 1e-12);
  EXPECT_NEAR(ways[3], 0, 1e-12);
  const ModelError error;
  const Matrix c = unabsorbed_error(r, error, 5e-3, ways);
  EXPECT_NEAR(std::sqrt(c(0, 0)), error.left * 8e-3 / 5e-4, 1e-9);
  EXPECT_NEAR(std::sqrt(c(3, 3)), error.least / 5e-4, 1e-9);
  const Matrix other = unabsorbed_error(r, error.of_another_speaker(), 5e-3, ways);
  EXPECT_GT(other(3, 3), c(3, 3));
}

TEST_F(TargetTest, AnOutlierCountsLittleUnderStudentsNoise) {
  const Target clean = pulled({{"GGP", 3}});
  Target dirty = clean;
  for (int k : {10, 11, 25}) dirty.curve[size_t(k)].position += Vec2(0, 0.012);
  Target robust = dirty;
  robust.outlier_dof = 4;
  const auto off = [&](const Target& t) {
    const Answer a = infer(m, t, Prior{}, ws);
    EXPECT_EQ(a.status, InferStatus::converged) << a.message;
    return Comparison(m, clean)(a.shape).rms;
  };
  const double plain = off(dirty), t_noise = off(robust);
  EXPECT_LT(t_noise, 0.35 * plain);
  EXPECT_LT(1e3 * t_noise, 0.3);
}

}  // namespace
}  // namespace genio
