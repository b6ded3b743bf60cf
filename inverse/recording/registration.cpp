#include "inverse/recording/registration.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlopt.hpp>
#include <numbers>

namespace genio {
namespace {

constexpr double palate_sd = 2e-3, tongue_sd = 5e-3;  // [m]
constexpr size_t most_trace = 42;                     // independent points of a palate trace
constexpr double scale_sd = 0.06, tilt_sd = 20 * std::numbers::pi / 180;

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

/// At most `count` points spread evenly over all contours.
std::vector<Vec2> thin(const std::vector<std::vector<Vec2>>& contours, size_t count) {
  std::vector<Vec2> all;
  for (const auto& c : contours) all.insert(all.end(), c.begin(), c.end());
  std::vector<Vec2> some;
  const size_t stride = std::max<size_t>(1, all.size() / count);
  for (size_t i = 0; i < all.size(); i += stride) some.push_back(all[i]);
  return some;
}

struct Problem {
  Polyline palate, tongue;
  std::vector<Vec2> trace, contours;
  Vec2 centre;  // of the trace: rotation and scale act about it

  Similarity transform(const std::vector<double>& v) const {
    Similarity s;
    s.angle = v[0], s.scale = std::exp(v[1]);
    s.shift = Vec2(v[2], v[3]);
    const Vec2 turned = Similarity{s.scale, s.angle, Vec2::Zero()}(centre);
    s.shift -= turned;
    return s;
  }
  double cost(const std::vector<double>& v) const {
    const Similarity s = transform(v);
    double sum = 0, misfit = 0;
    for (const Vec2& q : trace) sum += palate.offset(s(q)).squaredNorm() / (palate_sd * palate_sd);
    // A sweep of a sensor says no more than a trace.
    if (trace.size() > most_trace) sum *= double(most_trace) / double(trace.size());
    for (const Vec2& q : contours)
      misfit += tongue.offset(s(q)).squaredNorm() / (tongue_sd * tongue_sd);
    // All contours together weigh as much as 60 independent points.
    if (!contours.empty()) sum += 60 * misfit / double(contours.size());
    return sum + v[0] * v[0] / (tilt_sd * tilt_sd) + v[1] * v[1] / (scale_sd * scale_sd);
  }
};

}  // namespace

Vec2 Similarity::operator()(const Vec2& q) const {
  const double c = std::cos(angle), s = std::sin(angle);
  return scale * Vec2(c * q[0] - s * q[1], s * q[0] + c * q[1]) + shift;
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
  problem.tongue.points = TongueLine(model).sample(model.rest, 60);
  problem.trace = palate_trace;
  problem.contours = thin(contours, 400);
  problem.centre = Vec2::Zero();
  for (const Vec2& q : palate_trace) problem.centre += q / double(palate_trace.size());

  nlopt::opt optimiser(nlopt::LN_SBPLX, 4);
  optimiser.set_min_objective([](const std::vector<double>& v, std::vector<double>&,
                                 void* data) { return static_cast<const Problem*>(data)->cost(v); },
                              &problem);
  optimiser.set_xtol_rel(1e-7);
  optimiser.set_maxeval(2000);
  optimiser.set_initial_step(std::vector<double>{0.1, 0.05, 3e-3, 3e-3});
  double best = std::numeric_limits<double>::infinity();
  std::vector<double> best_point;
  const size_t count = problem.palate.points.size();
  for (double along : {0.2, 0.35, 0.5, 0.65}) {  // where on the palate the trace's middle lies
    const Vec2 start = problem.palate.points[size_t(along * double(count - 1))];
    for (double tilt : {-0.25, 0.0, 0.25}) {
      std::vector<double> v = {tilt, 0, start[0], start[1]};
      double value = 0;
      optimiser.optimize(v, value);
      if (value < best) best = value, best_point = v;
    }
  }
  Registration result;
  result.transform = problem.transform(best_point);
  result.cost = best;
  double sum = 0;
  for (const Vec2& q : palate_trace)
    sum += problem.palate.offset(result.transform(q)).squaredNorm();
  result.palate_rms = std::sqrt(sum / double(palate_trace.size()));
  return result;
}

}  // namespace genio
