#include "inverse/posterior/box_gaussian.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <stdexcept>
#include <vector>

namespace genio {
namespace {

constexpr double inside = 1e-9;  // of the box: where the first trajectory starts off a bound
constexpr int most_bounces = 2000;
constexpr double pressing = 30;  // slope at a bound, in units of the Gaussian's own

/// First time t > 0 at which a sin t + b cos t + c falls to zero; it does.
double hit(double a, double b, double c) {
  // size cos(t - phase) = -c, on its way down
  double t = std::atan2(a, b) + std::acos(std::clamp(-c / std::hypot(a, b), -1.0, 1.0));
  t = std::fmod(t, 2 * std::numbers::pi);
  return t < 0 ? t + 2 * std::numbers::pi : t;
}

/// What h(t) = a sin t + b cos t + c >= 0 allows of a quarter circle, for many h at once.
struct Arc {
  double end, sine, cosine;
  Eigen::Index wall = -1;  // that ends it

  explicit Arc(double longest) { stop(longest, -1); }
  void stop(double t, Eigen::Index at) {
    end = t, sine = std::sin(t), cosine = std::cos(t), wall = at;
  }
  /// h(0) >= 0. Over a quarter circle h has one minimum at most, so that its ends tell whether it
  /// can have a root at all: most need no trigonometry.
  void cut(double a, double b, double c, Eigen::Index at) {
    const bool below = a * sine + b * cosine + c < 0;
    const bool dips = a < 0 && a * cosine - b * sine > 0 && a * a + b * b > c * c;
    if (!below && !dips) return;
    if (const double t = hit(a, b, c); t < end) stop(t, at);
  }
};

/// Hamiltonian Monte Carlo on all of the unknowns.
Matrix bouncing(const BoxGaussian& g, int count, int warming, std::mt19937_64& random) {
  const Eigen::Index n = g.mode.size();
  const Eigen::LLT<Matrix> factor(g.hessian);
  if (factor.info() != Eigen::Success)
    throw InputError(
        "the posterior's curvature is not definite: the standard deviations of prior and noise lie "
        "too far apart");
  const Vector centre = g.mode - factor.solve(g.slope);
  // z = centre + R y with y standard normal; the bounds are rows . y + offset >= 0.
  const Matrix r = factor.matrixU().solve(Matrix::Identity(n, n));
  Matrix rows(2 * n, n);
  Vector offset(2 * n);
  rows << r, -r;
  offset << centre - g.lower, g.upper - centre;
  const Matrix products = rows * rows.transpose();
  const Vector slack = inside * (g.upper - g.lower);
  const Vector start = g.mode.cwiseMax(g.lower + slack).cwiseMin(g.upper - slack);
  Vector y = factor.matrixU() * (start - centre);
  std::normal_distribution<double> normal;
  Matrix samples(n, count);
  for (int k = -warming; k < count; ++k) {
    Vector v(n);
    for (auto& e : v) e = normal(random);
    Vector a = rows * v, b = rows * y;
    double left = 0.5 * std::numbers::pi;
    for (int bounce = 0; bounce < most_bounces && left > 0; ++bounce) {
      Arc arc(left);
      for (Eigen::Index i = 0; i < 2 * n; ++i) arc.cut(a[i], b[i], offset[i], i);
      const auto turn = [&](Vector& along, Vector& at) {
        const Vector before = along;
        along = arc.cosine * before - arc.sine * at;
        at = arc.sine * before + arc.cosine * at;
      };
      turn(v, y), turn(a, b);
      left -= arc.end;
      if (arc.wall < 0) break;
      const double back = 2 * a[arc.wall] / products(arc.wall, arc.wall);
      v -= back * rows.row(arc.wall).transpose();
      a -= back * products.col(arc.wall);
    }
    if (k >= 0) samples.col(k) = (centre + r * y).cwiseMax(g.lower).cwiseMin(g.upper);
  }
  return samples;
}

}  // namespace

BoxGaussian about(const Vector& centre, const Matrix& hessian, const Vector& lower,
                  const Vector& upper) {
  const Vector mode = centre.cwiseMax(lower).cwiseMin(upper);
  return {mode, hessian * (mode - centre), hessian, lower, upper};
}

BoxGaussian at_mode(BoxGaussian g) {
  // One unknown after another: H is definite, so that this converges.
  constexpr int most = 1000;
  constexpr double still = 1e-9;  // of the width between the bounds
  for (int sweep = 0; sweep < most; ++sweep) {
    double moved = 0;
    for (Eigen::Index i = 0; i < g.mode.size(); ++i) {
      const double to =
          std::clamp(g.mode[i] - g.slope[i] / g.hessian(i, i), g.lower[i], g.upper[i]);
      const double by = to - g.mode[i];
      g.mode[i] = to, g.slope += by * g.hessian.col(i);
      moved = std::max(moved, std::abs(by) / (g.upper[i] - g.lower[i]));
    }
    if (moved < still) break;
  }
  return g;
}

int pressed(const BoxGaussian& g, Eigen::Index i) {
  if (g.slope[i] > 0 && g.mode[i] < g.lower[i] + at_bound) return -1;
  if (g.slope[i] < 0 && g.mode[i] > g.upper[i] - at_bound) return 1;
  return 0;
}

Matrix sample(const BoxGaussian& g, int count, int warming, unsigned seed) {
  std::mt19937_64 random(seed);
  // Against a bound that presses hard a trajectory would bounce for ever. There the density is an
  // exponential too narrow for the others to notice.
  std::vector<Eigen::Index> soft, hard;
  for (Eigen::Index i = 0; i < g.mode.size(); ++i) {
    const bool hard_pressed = std::abs(g.slope[i]) > pressing * std::sqrt(g.hessian(i, i));
    (pressed(g, i) != 0 && hard_pressed ? hard : soft).push_back(i);
  }
  Matrix samples(g.mode.size(), count);
  std::uniform_real_distribution<double> uniform;
  for (auto i : hard) {
    const double rate = std::abs(g.slope[i]), width = g.upper[i] - g.lower[i];
    for (int k = 0; k < count; ++k) {
      const double off = -std::log1p(uniform(random) * std::expm1(-rate * width)) / rate;
      samples(i, k) = g.slope[i] > 0 ? g.lower[i] + off : g.upper[i] - off;
    }
  }
  if (soft.empty()) return samples;
  samples(soft, Eigen::all) =
      bouncing({g.mode(soft), g.slope(soft), g.hessian(soft, soft), g.lower(soft), g.upper(soft)},
               count, warming, random);
  return samples;
}

}  // namespace genio
