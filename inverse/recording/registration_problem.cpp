#include "inverse/recording/registration_problem.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <nlopt.hpp>
#include <numbers>

namespace genio {
namespace {

constexpr double palate_sd = 2e-3;  // [m]
constexpr double bent_sd = 2.5e-3;  // of contours about a line that is bent to them [m]
constexpr size_t most_trace = 42;   // independent points of a palate trace
constexpr double usual_scale_sd = 0.06, free_scale_sd = 1;
constexpr double tilt_sd = 20 * std::numbers::pi / 180;
constexpr int turns = 6;            // of lines and registration
constexpr double shape_frames = 3;  // whose shapes count

/// Squared distances of the points from a line times `each`, and their slope in v.
double misfit(const std::vector<Vec2>& points, const std::vector<Vec2>& line, double each,
              const Similarity& s, const Vec2& middle, Eigen::Vector4d& slope) {
  double sum = 0;
  for (const Vec2& q : points) {
    const Vec2 at = s(q), off = foot_on(line, at).offset, arm = at - middle;
    sum += each * off.squaredNorm();
    slope +=
        2 * each * Eigen::Vector4d(off[1] * arm[0] - off[0] * arm[1], off.dot(arm), off[0], off[1]);
  }
  return sum;
}

}  // namespace

Similarity RegistrationProblem::transform(const std::vector<double>& v) const {
  Similarity s{.scale = std::exp(v[1]), .angle = v[0]};
  s.shift = Vec2(v[2], v[3]) - s(centre);
  return s;
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
    sum += misfit(contours[k], lines[k], weight / double(points) / (line_sd * line_sd), s, middle,
                  slope);
  if (marks.hyoid) {
    const Vec2 at = s(marks.hyoid->in_recording), arm = at - middle,
               off = (at - marks.hyoid->in_model) / (marks.hyoid->sd * marks.hyoid->sd);
    sum += off.dot(at - marks.hyoid->in_model);
    slope += 2 * Eigen::Vector4d(off[1] * arm[0] - off[0] * arm[1], off.dot(arm), off[0], off[1]);
  }
  if (free) {
    // Else what fits badly would shrink: distances count in the device's own lengths.
    slope[1] -= 2 * sum;
    const double by = std::exp(-2 * v[1]);
    sum *= by, slope *= by;
  }
  const double scale_sd = free ? free_scale_sd : usual_scale_sd;
  const double turn = v[0] + (marks.bite_plane ? marks.bite_plane->tilt : 0),
               turn_sd = marks.bite_plane ? marks.bite_plane->sd : tilt_sd;
  slope[0] += 2 * turn / (turn_sd * turn_sd), slope[1] += 2 * v[1] / (scale_sd * scale_sd);
  sum += turn * turn / (turn_sd * turn_sd) + v[1] * v[1] / (scale_sd * scale_sd) + strain;
  if (!gradient.empty()) Eigen::Vector4d::Map(gradient.data()) = slope;
  return sum;
}

double minimise(const RegistrationProblem& problem, std::vector<double>& v) {
  nlopt::opt optimiser(nlopt::LD_SLSQP, 4);
  optimiser.set_min_objective(
      [](const std::vector<double>& at, std::vector<double>& gradient, void* data) {
        return static_cast<const RegistrationProblem*>(data)->cost(at, gradient);
      },
      const_cast<RegistrationProblem*>(&problem));
  optimiser.set_xtol_rel(1e-7);
  optimiser.set_maxeval(200);
  double value = 0;
  try {
    optimiser.optimize(v, value);
  } catch (const std::runtime_error&) {  // no more progress: where it stands will do
    std::vector<double> none;
    value = problem.cost(v, none);
  }
  return value;
}

double minimise_with_reach(RegistrationProblem& problem, const TongueReach& reach,
                           std::vector<double>& v) {
  problem.line_sd = bent_sd;
  double value = 0;
  for (int turn = 0; turn < turns; ++turn) {
    const Similarity s = problem.transform(v);
    problem.strain = 0;
    for (size_t k = 0; k < problem.contours.size(); ++k) {
      std::vector<Vec2> moved;
      for (const Vec2& q : problem.contours[k]) moved.push_back(s(q));
      ReachLine line = line_near(reach, moved, bent_sd);
      problem.lines[k] = std::move(line.points), problem.strain += line.strain;
    }
    const auto frames = double(problem.contours.size());
    if (frames > shape_frames) problem.strain *= shape_frames / frames;
    value = minimise(problem, v);
  }
  return value;
}

Eigen::Matrix4d covariance(const RegistrationProblem& problem, const std::vector<double>& v) {
  constexpr double step[] = {1e-3, 1e-3, 1e-5, 1e-5};
  Eigen::Matrix4d hessian;
  for (int k = 0; k < 4; ++k) {
    std::vector<double> up = v, down = v, high(4), low(4);
    up[size_t(k)] += step[k], down[size_t(k)] -= step[k];
    problem.cost(up, high), problem.cost(down, low);
    for (int i = 0; i < 4; ++i) hessian(i, k) = (high[size_t(i)] - low[size_t(i)]) / (2 * step[k]);
  }
  return 2 * (0.5 * (hessian + hessian.transpose())).ldlt().solve(Eigen::Matrix4d::Identity());
}

}  // namespace genio
