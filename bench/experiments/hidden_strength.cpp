#include "bench/experiments/hidden_strength.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "forward/model/build_model.hpp"
#include "forward/statics/sensitivity.hpp"
#include "inverse/shape/curvature.hpp"
#include "inverse/target/comparison.hpp"
#include "inverse/target/head_pose.hpp"
#include "inverse/target/moved_target.hpp"

namespace genio::bench {
namespace {

constexpr double effort_sd = 0.12;
constexpr int most_refits = 6;
constexpr int line_points = 32, across_points = 20, scattered_points = 90;

void lay(std::vector<Measured>& points, const HeadPose& pose) {
  Vec2 middle = Vec2::Zero();
  for (const auto& p : points) middle += Vec2(p.position[0], p.position[2]) / double(points.size());
  const MovedTarget moved(pose, middle);
  for (auto& p : points) p.position = moved(p.position);
}

/// The least squares step |r + J d|^2 + |(z + d - mean) / sd|^2 with z + d >= 0: what would go
/// below stays at 0.
Vector bounded_step(const Vector& r, const Matrix& j, const Vector& z, const Vector& mean,
                    const Vector& sd) {
  const auto n = z.size();
  std::vector<bool> at_zero(size_t(n), false);
  Vector d = Vector::Zero(n);
  for (bool again = true; again;) {
    std::vector<Eigen::Index> free;
    d = -z;
    for (Eigen::Index i = 0; i < n; ++i)
      if (!at_zero[size_t(i)]) free.push_back(i), d[i] = 0;
    if (free.empty()) break;
    const Matrix a = j(Eigen::all, free);
    const Vector weight = sd(free).cwiseAbs2().cwiseInverse();
    const Matrix h = a.transpose() * a + Matrix(weight.asDiagonal());
    const Vector g = a.transpose() * (r + j * d) + weight.cwiseProduct(z(free) - mean(free));
    d(free) = -h.llt().solve(g);
    again = false;
    for (Eigen::Index i : free)
      if (z[i] + d[i] < 0) again = at_zero[size_t(i)] = true;
  }
  return d;
}

/// A posture's residuals after its forces were refitted to `target`, from those it was made with;
/// empty where there is no equilibrium.
Vector after_refit(const Model& m, Equilibrium e, const Target& target, bool known, Workspace& ws) {
  const Comparison comparison(m, target);
  const auto commands = muscle_unknowns(m, !known);
  const auto n = Eigen::Index(commands.size());
  Vector z(n), sd = Vector::Constant(n, effort_sd), mean = Vector::Zero(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Unknown& c = commands[size_t(i)];
    z[i] = 0;
    for (int k : c.parameters) z[i] += e.parameters[k] / c.scale;
  }
  if (known) mean = z, sd = (force_error * z).cwiseMax(1e-6);
  Residuals r = comparison(e.x);
  for (int step = 0; step < most_refits; ++step) {
    const Matrix j = residual_jacobian(
        r, sensitivity_to_forces(m, e, force_by_unknown(m, commands, e.x, e.parameters), ws));
    const Vector d = bounded_step(r.values, j, z, mean, sd);
    const auto cost = [&](const Vector& values, const Vector& at) {
      return values.squaredNorm() + (at - mean).cwiseQuotient(sd).squaredNorm();
    };
    const double before = cost(r.values, z);
    bool better = false;
    for (double part = 1; part > 0.1 && !better; part *= 0.5) {
      const Vector next = z + part * d;
      const Equilibrium there =
          solve_equilibrium(m, apply_unknowns(commands, next, default_parameters(m)), e.x, ws);
      if (!there) continue;
      const Residuals at_next = comparison(there.x);
      if (cost(at_next.values, next) > before) continue;
      better = true, z = next, e = there, r = at_next;
    }
    if (!better || before - cost(r.values, z) < 0.01 * before) break;
  }
  return r.values;
}

/// What is left of the change's marks on the data once the forces have done their best, in units of
/// the noise (root mean square over points and conditions); on the coarse mesh. Negative: no
/// equilibrium.
double excess(const ModelDescription& tongue, const Changes& changes,
              const std::vector<Forces_N>& all, const HiddenCase& what) {
  const Model without = build_model(changes.shipped(tongue), "shipped");
  const Model with = changes.by_hand(build_model(changes.truth(tongue), "truth"));
  Workspace ws(without), ws_with(with);
  double sum = 0, count = 0;
  std::mt19937 random(1);
  for (const auto& forces : all) {
    const Equilibrium a = solve_equilibrium(without, commanded(without, forces), without.rest, ws);
    const Equilibrium b = solve_equilibrium(with, commanded(with, forces), a.x, ws_with);
    if (!a || !b) return -1;
    const auto points = seen(with, b.x, what, changes, random);
    const Vector left =
        after_refit(without, a, target_of(points, what.noise), what.forces_known, ws);
    sum += left.squaredNorm(), count += double(left.size());
  }
  return std::sqrt(sum / count);
}

}  // namespace

Parameters commanded(const Model& m, const Forces_N& forces, bool half) {
  Parameters p = default_parameters(m);
  for (const auto& [name, f] : forces) set_command(m, name, half ? 0.5 * f : f, p);
  return p;
}

std::vector<Measured> seen(const Model& model, const Positions& x, const HiddenCase& what,
                           const Changes& changes, std::mt19937& random) {
  auto points = what.surface ? surface_of(model, x, scattered_points, random)
                             : contours_of(model, x, line_points, across_points);
  lay(points, changes.pose());
  return points;
}

bool find_amplitude(const ModelDescription& tongue, const HiddenChange& change,
                    const std::vector<Forces_N>& fitted, const HiddenCase& what, double strength,
                    double& s) {
  double low = 0, high = -1, at_low = 0;
  s = change.first;
  for (int i = 0; i < 12; ++i) {
    const double e = excess(tongue, {{change}, {s}}, fitted, what);
    if (e >= 0 && std::abs(e - strength) < 0.05 * strength) return true;
    if (e < 0 || e > strength) {
      high = s;
    } else {
      low = s, at_low = e;
    }
    if (high < 0) {
      if (s >= change.most) return false;
      s = std::min(change.most,
                   at_low > 0 ? std::clamp(s * strength / at_low, 1.3 * s, 4 * s) : 3 * s);
    } else {
      s = e > 0 && e > strength
              ? std::clamp(s * strength / e, low + 0.1 * (high - low), low + 0.9 * (high - low))
              : 0.5 * (low + high);
    }
  }
  return false;
}

}  // namespace genio::bench
