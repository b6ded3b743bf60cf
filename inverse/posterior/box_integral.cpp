#include "inverse/posterior/box_integral.hpp"

// The mass of a Gaussian within bounds by expectation propagation (Cunningham, Hennig &
// Lacoste-Julien 2011, arXiv:1111.6832): each pair of bounds counts as a Gaussian in its unknown
// that gives the same first two moments. Bounds by the unknowns' axes are where it is most
// accurate.

#include <Eigen/Cholesky>
#include <cmath>
#include <numbers>
#include <tuple>

namespace genio {
namespace {

constexpr double far = 30;          // standard deviations: the tail is an exponential
constexpr double flat = 1e-3;       // standard deviations: the density between the bounds is even
constexpr double tolerance = 1e-5;  // of the logarithm
constexpr int most_sweeps = 50;
constexpr int calm = 10;  // sweeps, after which steps are halved: point masses may swing

/// log of the standard normal's mass beyond a.
double log_tail(double a) {
  if (a < far) return std::log(0.5 * std::erfc(a / std::numbers::sqrt2));
  const double b = 1 / (a * a);
  return -0.5 * a * a - std::log(a) - 0.5 * std::log(2 * std::numbers::pi) +
         std::log1p(b * (-1 + b * (3 - 15 * b)));
}

struct Moments {
  double log_mass, mean, variance;
};

/// Of a standard normal between a < b, a the bound nearer to 0 or beyond it.
Moments between(double a, double b) {
  if (b - a < flat) {
    const double middle = 0.5 * (a + b), width = b - a;
    return {-0.5 * middle * middle + std::log(width) - 0.5 * std::log(2 * std::numbers::pi), middle,
            width * width / 12};
  }
  const double tail = log_tail(a), beyond = log_tail(b);
  const double mass = tail + std::log1p(-std::exp(beyond - tail));
  if (a > far && beyond - tail < -40) {
    const double c = 1 / (a * a);
    return {mass, a + (1 - c * (2 - 10 * c)) / a, c * (1 - c * (6 - 50 * c))};
  }
  const auto density = [&](double y) {
    return std::exp(-0.5 * y * y - 0.5 * std::log(2 * std::numbers::pi) - mass);
  };
  const double at_a = density(a), at_b = density(b), mean = at_a - at_b;
  const double by_b = at_b > 0 ? b * at_b : 0;
  return {mass, mean, 1 + a * at_a - by_b - mean * mean};
}

/// Of a normal of that mean and variance.
Moments within(double mean, double variance, double lower, double upper) {
  const double sd = std::sqrt(variance), a = (lower - mean) / sd, b = (upper - mean) / sd;
  const bool mirrored = a + b < 0;
  Moments m = mirrored ? between(-b, -a) : between(a, b);
  m.mean = mean + (mirrored ? -sd : sd) * m.mean;
  m.variance = std::max(m.variance, 1e-12) * variance;
  return m;
}

/// Moments of that normal under the even measure between its bounds and a point mass at the lower.
Moments with_spike(double mean, double variance, double lower, double upper, double spike) {
  const Moments box = within(mean, variance, lower, upper);
  if (spike <= 0) return box;
  const double off = lower - mean;
  const double log_spike = std::log(spike) - 0.5 * std::log(2 * std::numbers::pi * variance) -
                           0.5 * off * off / variance;
  const double most = std::max(box.log_mass, log_spike);
  const double sum = std::exp(box.log_mass - most) + std::exp(log_spike - most);
  const double part = std::exp(box.log_mass - most) / sum;  // of the box
  const double apart = box.mean - lower;
  return {most + std::log(sum), lower + part * apart,
          part * box.variance + part * (1 - part) * apart * apart};
}

/// log of the integral of exp(shift y - precision y^2 / 2), but for log(2 pi) / 2.
double log_normaliser(double shift, double precision) {
  return 0.5 * shift * shift / precision - 0.5 * std::log(precision);
}

}  // namespace

double log_integral(const BoxGaussian& g) { return integral(g, Vector::Zero(g.mode.size())).log; }

BoxIntegral integral(const BoxGaussian& g, const Vector& spikes) {
  const Eigen::Index n = g.mode.size();
  BoxIntegral all{0, g.mode, Vector::Zero(n)};
  if (n == 0) return all;
  Vector precision = Vector::Zero(n), shift = Vector::Zero(n);  // of each unknown's stand-in
  for (int sweep = 0; sweep < most_sweeps; ++sweep) {
    const Eigen::LLT<Matrix> factor(g.hessian + Matrix(precision.asDiagonal()));
    Matrix covariance = factor.solve(Matrix::Identity(n, n));
    Vector total = shift - g.slope;  // of the whole
    Vector mean = covariance * total;
    double sum = 0.5 * total.dot(mean) - Matrix(factor.matrixL()).diagonal().array().log().sum();
    // What the others say of an unknown, and its moments once its own bounds count.
    const auto others = [&](Eigen::Index i) {
      const double here = 1 / covariance(i, i);
      const double p = here - precision[i], s = mean[i] * here - shift[i];
      return std::tuple(
          p, s,
          with_spike(s / p, 1 / p, g.lower[i] - g.mode[i], g.upper[i] - g.mode[i], spikes[i]));
    };
    for (Eigen::Index i = 0; i < n; ++i) {
      const auto [p, s, m] = others(i);
      const double here = 1 / covariance(i, i);
      sum += m.log_mass + log_normaliser(s, p) - log_normaliser(mean[i] * here, here);
      all.centre[i] = g.mode[i] + s / p, all.sd[i] = std::sqrt(1 / p);
    }
    sum += 0.5 * double(n) * std::log(2 * std::numbers::pi);
    const bool settled = std::abs(sum - all.log) < tolerance;
    all.log = sum;
    if (sweep > 0 && settled) break;
    const double part = sweep < calm ? 1 : 0.5;
    for (Eigen::Index i = 0; i < n; ++i) {
      const auto [p, s, m] = others(i);
      const double dp = part * (std::max(0.0, 1 / m.variance - p) - precision[i]);
      const double ds = part * (m.mean / m.variance - s - shift[i]);
      precision[i] += dp, shift[i] += ds;
      // Sherman & Morrison 1950, and the mean along with it.
      const Vector column = covariance.col(i);
      const double k = dp / (1 + dp * covariance(i, i));
      mean += column * (ds - k * (mean[i] + ds * covariance(i, i)));
      covariance -= k * column * column.transpose();
    }
  }
  return all;
}

CutNormal cut_normal(double centre, double sd, double lower, double upper) {
  CutNormal cut{std::clamp(centre, lower, upper), 0, 0, 0};
  cut.sd = std::sqrt(within(centre, sd * sd, lower, upper).variance);
  // All that is nearer to the centre than some distance.
  const auto low = [&](double t) { return std::max(lower, centre - t); };
  const auto high = [&](double t) { return std::min(upper, centre + t); };
  double least = std::abs(cut.mode - centre), most = least;
  for (double step = sd; low(most) > lower || high(most) < upper; step *= 2) most += step;
  const double whole = within(centre, sd * sd, lower, upper).log_mass + std::log(0.9);
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (least + most);
    const bool enough = within(centre, sd * sd, low(middle), high(middle)).log_mass > whole;
    (enough ? most : least) = middle;
  }
  cut.low = low(most), cut.high = high(most);
  return cut;
}

}  // namespace genio
