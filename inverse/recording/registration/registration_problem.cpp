#include "inverse/recording/registration/registration_problem.hpp"

#include <algorithm>
#include <cmath>
#include <nlopt.hpp>

namespace genio {
namespace {

constexpr double rest_sd = 5e-3;  // of contours about the line at rest [m]
constexpr double free_scale_sd = 1;

/// Squared distances of the points from a line times `each`, and their slope in v.
double misfit(const std::vector<Vec2>& points, const std::vector<Vec2>& line, double each,
              const Similarity& s, const Vec2& middle, Eigen::Vector4d& slope) {
  double sum = 0;
  for (const Vec2& q : points) {
    const Vec2 at = s(q), off = foot_on(line, at).offset;
    sum += each * off.squaredNorm();
    slope += 2 * each * by_registration(at, middle).transpose() * off;
  }
  return sum;
}

}  // namespace

Similarity RegistrationProblem::transform(const std::vector<double>& v) const {
  Similarity s{.scale = std::exp(v[1]), .angle = v[0]};
  s.shift = Vec2(v[2], v[3]) - s(centre);
  return s;
}

Eigen::Matrix<double, 2, 4> by_registration(const Vec2& at, const Vec2& middle) {
  const Vec2 arm = at - middle;
  Eigen::Matrix<double, 2, 4> rows;
  rows << -arm[1], arm[0], 1, 0, arm[0], arm[1], 0, 1;
  return rows;
}

Beliefs beliefs(const RegistrationProblem& problem, const std::vector<double>& v) {
  Beliefs b;
  const auto& plane = problem.marks.bite_plane;
  const double turn = v[0] + (plane ? plane->tilt : 0), turn_sd = plane ? plane->sd : tilt_sd;
  const double scale_sd = problem.free ? free_scale_sd : problem.scale_sd;
  b.curvature(0, 0) = 1 / (turn_sd * turn_sd), b.curvature(1, 1) = 1 / (scale_sd * scale_sd);
  b.slope[0] = turn * b.curvature(0, 0), b.slope[1] = v[1] * b.curvature(1, 1);
  b.cost = turn * b.slope[0] + v[1] * b.slope[1];
  for (const auto& [point, known] : problem.marks.points) {
    const Vec2 at = problem.transform(v)(known.in_recording), off = at - known.in_model;
    const double each = 1 / (known.sd * known.sd);
    const auto rows = by_registration(at, Vec2(v[2], v[3]));
    b.cost += each * off.squaredNorm();
    b.slope += each * rows.transpose() * off;
    b.curvature += each * rows.transpose() * rows;
  }
  return b;
}

double RegistrationProblem::cost(const std::vector<double>& v,
                                 std::vector<double>& gradient) const {
  const Similarity s = transform(v);
  const Vec2 middle(v[2], v[3]);
  Eigen::Vector4d slope = Eigen::Vector4d::Zero();
  // A sweep of a sensor says no more than a trace.
  const double of_trace =
      double(std::min(trace.size(), most_trace)) / std::max<double>(1, double(trace.size()));
  double sum = misfit(trace, palate, of_trace / (palate_sd * palate_sd), s, middle, slope);
  size_t points = 0;
  for (const auto& contour : contours) points += contour.size();
  for (size_t k = 0; k < contours.size(); ++k)
    sum +=
        misfit(contours[k], rest, weight / double(points) / (rest_sd * rest_sd), s, middle, slope);
  // Distances count in the device's own lengths, else what fits badly would shrink.
  slope[1] -= 2 * sum;
  const double by = std::exp(-2 * v[1]);
  sum *= by, slope *= by;
  const Beliefs known = beliefs(*this, v);
  sum += known.cost, slope += 2 * known.slope;
  if (!gradient.empty()) Eigen::Vector4d::Map(gradient.data()) = slope;
  return sum;
}

double minimise(const RegistrationProblem& problem, std::vector<double>& v) {
  nlopt::opt optimiser(nlopt::LD_SLSQP, 4);
  optimiser.set_min_objective(
      [](const std::vector<double>& at, std::vector<double>& gradient, void* data) {
        const auto& searched = *static_cast<const RegistrationProblem*>(data);
        searched.step();
        return searched.cost(at, gradient);
      },
      const_cast<RegistrationProblem*>(&problem));
  optimiser.set_xtol_rel(1e-7);
  optimiser.set_maxeval(200);
  double value = 0;
  try {
    optimiser.optimize(v, value);
  } catch (const std::runtime_error&) {  // no more progress: where it stands will do
    problem.step();                      // unless that ended the search
    std::vector<double> none;
    value = problem.cost(v, none);
  }
  return value;
}

}  // namespace genio
