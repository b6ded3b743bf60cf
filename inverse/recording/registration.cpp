#include "inverse/recording/registration.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <nlopt.hpp>
#include <numbers>

namespace genio {
namespace {

constexpr double palate_sd = 2e-3, tongue_sd = 5e-3;  // [m]
constexpr size_t most_trace = 42;                     // independent points of a palate trace
// Independent points of all contours. Without a palate a recording's mean shape off the rest shape
// looks like a head that is off, so that they say less.
constexpr double contours_weight = 60, alone_weight = 6;
constexpr size_t enough = 200;  // points of either that are looked at
constexpr double usual_scale_sd = 0.06, free_scale_sd = 1, tilt_sd = 20 * std::numbers::pi / 180;

struct Polyline {
  std::vector<Vec2> points;
  /// Vector from the nearest point of the line to q.
  Vec2 offset(const Vec2& q) const {
    double best = std::numeric_limits<double>::infinity();
    Vec2 result = Vec2::Zero();
    for (size_t i = 0; i + 1 < points.size(); ++i) {
      const Vec2 a = points[i], d = points[i + 1] - a;
      const double t = std::clamp((q - a).dot(d) / std::max(d.squaredNorm(), 1e-30), 0.0, 1.0);
      const Vec2 off = q - a - t * d;
      if (off.squaredNorm() < best) best = off.squaredNorm(), result = off;
    }
    return result;
  }
};

struct Problem {
  Polyline palate, tongue;
  std::vector<Vec2> trace, contours;
  double weight = contours_weight;
  bool free = false;           // nothing is believed of the scale
  Vec2 centre = Vec2::Zero();  // of the trace: rotation and scale act about it

  Similarity transform(const std::vector<double>& v) const {
    Similarity s;
    s.angle = v[0], s.scale = std::exp(v[1]);
    s.shift = Vec2(v[2], v[3]);
    const Vec2 turned = Similarity{s.scale, s.angle, Vec2::Zero()}(centre);
    s.shift -= turned;
    return s;
  }
  /// Squared distances of the points from a line, each over weight^-1, and its slope in v.
  double misfit(const std::vector<Vec2>& points, const Polyline& line, double each,
                const std::vector<double>& v, Eigen::Vector4d& slope) const {
    const Similarity s = transform(v);
    const Vec2 middle(v[2], v[3]);
    double sum = 0;
    for (const Vec2& q : points) {
      const Vec2 at = s(q), off = line.offset(at), arm = at - middle;
      sum += each * off.squaredNorm();
      slope += 2 * each *
               Eigen::Vector4d(off[1] * arm[0] - off[0] * arm[1], off.dot(arm), off[0], off[1]);
    }
    return sum;
  }
  double cost(const std::vector<double>& v, std::vector<double>& gradient) const {
    Eigen::Vector4d slope = Eigen::Vector4d::Zero();
    // A sweep of a sensor says no more than a trace.
    const double of_trace =
        double(std::min(trace.size(), most_trace)) / std::max<double>(1, double(trace.size()));
    double sum = misfit(trace, palate, of_trace / (palate_sd * palate_sd), v, slope);
    if (!contours.empty())
      sum += misfit(contours, tongue, weight / double(contours.size()) / (tongue_sd * tongue_sd), v,
                    slope);
    if (free) {
      // Else what fits badly would shrink: distances count in the device's own lengths.
      const double by = std::exp(-2 * v[1]);
      slope[1] -= 2 * sum;
      sum *= by, slope *= by;
    }
    const double scale_sd = free ? free_scale_sd : usual_scale_sd;
    slope +=
        Eigen::Vector4d(2 * v[0] / (tilt_sd * tilt_sd), 2 * v[1] / (scale_sd * scale_sd), 0, 0);
    sum += v[0] * v[0] / (tilt_sd * tilt_sd) + v[1] * v[1] / (scale_sd * scale_sd);
    if (!gradient.empty()) Eigen::Vector4d::Map(gradient.data()) = slope;
    return sum;
  }
};

/// At most `count` points spread evenly.
std::vector<Vec2> thin(const std::vector<Vec2>& all, size_t count) {
  std::vector<Vec2> some;
  const double stride = std::max(1.0, double(all.size()) / double(count));
  for (double i = 0; i < double(all.size()); i += stride) some.push_back(all[size_t(i)]);
  return some;
}

/// Inverse of the Hessian at the optimum, by differences of the exact slope.
Eigen::Matrix4d covariance(const Problem& problem, const std::vector<double>& v) {
  const std::vector<double> step = {1e-3, 1e-3, 1e-5, 1e-5};
  Eigen::Matrix4d hessian;
  for (int k = 0; k < 4; ++k) {
    std::vector<double> up = v, down = v, high(4), low(4);
    up[size_t(k)] += step[size_t(k)], down[size_t(k)] -= step[size_t(k)];
    problem.cost(up, high), problem.cost(down, low);
    for (int i = 0; i < 4; ++i)
      hessian(i, k) = (high[size_t(i)] - low[size_t(i)]) / (2 * step[size_t(k)]);
  }
  // The cost is twice minus the log posterior.
  return 2 * (0.5 * (hessian + hessian.transpose())).ldlt().solve(Eigen::Matrix4d::Identity());
}

/// Runs from `v` to the optimum near it and gives the cost there.
double minimise(Problem& problem, std::vector<double>& v) {
  nlopt::opt optimiser(nlopt::LD_SLSQP, 4);
  optimiser.set_min_objective(
      [](const std::vector<double>& at, std::vector<double>& gradient, void* data) {
        return static_cast<const Problem*>(data)->cost(at, gradient);
      },
      &problem);
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

/// The best of the optima from several starts.
Registration best_of(const Model& model, Problem problem,
                     const std::vector<std::vector<Vec2>>& contours,
                     const std::vector<Vec2>& middles) {
  problem.tongue.points = TongueLine(model).sample(model.rest, 60);
  std::vector<Vec2> all;
  for (const auto& c : contours) all.insert(all.end(), c.begin(), c.end());
  problem.contours = thin(all, enough);
  double best = std::numeric_limits<double>::infinity();
  std::vector<double> best_point;
  for (const Vec2& start : middles)
    for (double tilt : {-0.25, 0.0, 0.25}) {
      std::vector<double> v = {tilt, 0, start[0], start[1]};
      const double value = minimise(problem, v);
      if (value < best) best = value, best_point = v;
    }
  const Eigen::Matrix4d spread = covariance(problem, best_point);
  Registration result{.transform = problem.transform(best_point), .cost = best};
  result.shift_sd = {std::sqrt(std::max(0.0, spread(2, 2))),
                     std::sqrt(std::max(0.0, spread(3, 3)))};
  result.tilt_sd = std::sqrt(std::max(0.0, spread(0, 0)));
  problem.free = true;
  std::vector<double> none;
  result.free_gain = problem.cost(best_point, none);
  result.free_gain -= minimise(problem, best_point);
  result.free_scale = std::exp(best_point[1]);
  return result;
}

}  // namespace

Vec2 Similarity::operator()(const Vec2& q) const {
  const double c = std::cos(angle), s = std::sin(angle);
  return scale * Vec2(c * q[0] - s * q[1], s * q[0] + c * q[1]) + shift;
}

double rms_distance(const Similarity& s, const std::vector<Vec2>& points,
                    const std::vector<Vec2>& line) {
  const Polyline lies{line};
  double sum = 0;
  for (const Vec2& q : points) sum += lies.offset(s(q)).squaredNorm();
  return std::sqrt(sum / double(points.size()));
}

Registration register_by_palate(const Model& model, const std::vector<Vec2>& palate_trace,
                                const std::vector<std::vector<Vec2>>& contours) {
  if (!model.palate)
    throw InputError("registration needs a palate; the model file has none in [surfaces]");
  if (palate_trace.size() < 5)
    throw InputError("registration needs a palate trace of at least 5 points");
  Problem problem;
  const auto cut = midsagittal_cut(*model.palate);
  if (cut.empty()) throw InputError("the model's palate does not cross the midsagittal plane");
  problem.palate.points.assign(cut.front().begin(), cut.front().end());
  problem.trace = thin(palate_trace, enough);
  for (const Vec2& q : palate_trace) problem.centre += q / double(palate_trace.size());
  std::vector<Vec2> middles;  // where on the palate the trace's middle may lie
  const size_t count = problem.palate.points.size();
  for (double along : {0.2, 0.35, 0.5, 0.65})
    middles.push_back(problem.palate.points[size_t(along * double(count - 1))]);
  Registration result = best_of(model, std::move(problem), contours, middles);
  result.palate_rms = rms_distance(result.transform, palate_trace, cut.front());
  return result;
}

Registration register_by_contours(const Model& model,
                                  const std::vector<std::vector<Vec2>>& contours) {
  Problem problem;
  size_t count = 0;
  for (const auto& c : contours) {
    for (const Vec2& q : c) problem.centre += q;
    count += c.size();
  }
  if (count < 5) throw InputError("an alignment by contours needs at least 5 points");
  problem.centre /= double(count), problem.weight = alone_weight;
  const auto line = TongueLine(model).sample(model.rest, 60);
  std::vector<Vec2> middles;
  for (double along : {0.3, 0.4, 0.5, 0.6}) middles.push_back(line[size_t(along * 59)]);
  return best_of(model, std::move(problem), contours, middles);
}

}  // namespace genio
