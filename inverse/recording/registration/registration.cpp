#include "inverse/recording/registration/registration.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "forward/base/median.hpp"
#include "forward/base/thin.hpp"
#include "forward/model/at_anatomy.hpp"
#include "inverse/recording/registration/bent_lines.hpp"
#include "inverse/recording/registration/registration_problem.hpp"

namespace genio {
namespace {

// Without a palate a recording's mean shape off the rest shape looks like a head that is off, so
// that the contours say less.
constexpr double alone_weight = 6;
constexpr size_t enough_frames = 20, enough_points = 24, enough_trace = 60;

RegistrationProblem problem_of(const TongueReach& reach,
                               const std::vector<std::vector<Vec2>>& contours,
                               const HeadMarks& marks) {
  RegistrationProblem problem;
  problem.marks = marks;
  for (const auto& contour : thin(contours, enough_frames))
    problem.contours.push_back(thin(contour, enough_points));
  problem.rest = reach.rest, problem.on_step = reach.on_step;
  problem.scale_sd = reach.scale_sd;
  return problem;
}

/// Places from which an optimum is looked for: of the middle, each at several tilts.
std::vector<std::vector<double>> starts_at(const RegistrationProblem& problem,
                                           const std::vector<Vec2>& middles) {
  std::vector<std::vector<double>> starts;
  const double level = problem.marks.bite_plane ? -problem.marks.bite_plane->tilt : 0;
  for (const Vec2& middle : middles)
    for (double tilt : {-0.35, 0.0, 0.35})
      starts.push_back({level + tilt, 0, middle[0], middle[1]});
  return starts;
}

bool same_place(const std::vector<double>& a, const std::vector<double>& b) {
  return std::abs(a[0] - b[0]) < 0.03 && std::hypot(a[2] - b[2], a[3] - b[3]) < 2e-3;
}

/// The best of the optima with bent lines: from each start as it is, and from the optimum near it
/// about the line at rest.
BentFit best_fit(const RegistrationProblem& problem, const TongueReach& reach,
                 const std::vector<Vec2>& middles) {
  std::vector<std::vector<double>> starts = starts_at(problem, middles), each;
  for (std::vector<double> start : starts_at(problem, middles)) {
    minimise(problem, start);
    starts.push_back(std::move(start));
  }
  BentFit best;
  best.cost = std::numeric_limits<double>::infinity();
  for (const auto& start : starts) {
    if (std::any_of(each.begin(), each.end(),
                    [&](const auto& known) { return same_place(known, start); }))
      continue;
    each.push_back(start);
    if (BentFit fit = fit_bent_lines(problem, reach, start); fit.cost < best.cost)
      best = std::move(fit);
  }
  return best;
}

/// The registration of the problem's best optimum.
Registration best_of(const TongueReach& reach, const RegistrationProblem& problem,
                     const std::vector<Vec2>& middles) {
  const BentFit best = best_fit(problem, reach, middles);
  Registration result{.transform = problem.transform(best.v)};
  result.cost = best.cost;
  const auto sd = [&](int k) { return std::sqrt(std::max(0.0, best.spread(k, k))); };
  result.shift_sd = {sd(2), sd(3)}, result.tilt_sd = sd(0);
  std::vector<double> off;
  for (size_t k = 0; k < problem.contours.size(); ++k)
    off.push_back(rms_distance(result.transform, problem.contours[k], best.lines[k]));
  result.off_reach = median(std::move(off));
  // Bent lines would follow a wrong size: it is looked for about those at rest.
  RegistrationProblem of_any_size = problem;
  of_any_size.free = true;
  std::vector<double> v = best.v, none;
  minimise(problem, v);
  result.free_gain = of_any_size.cost(v, none);
  result.free_gain -= minimise(of_any_size, v);
  result.free_scale = std::exp(v[1]);
  return result;
}

}  // namespace

Vec2 Similarity::operator()(const Vec2& q) const {
  const double c = std::cos(angle), s = std::sin(angle);
  return scale * Vec2(c * q[0] - s * q[1], s * q[0] + c * q[1]) + shift;
}

double rms_distance(const Similarity& s, const std::vector<Vec2>& points,
                    const std::vector<Vec2>& line) {
  double sum = 0;
  for (const Vec2& q : points) sum += foot_on(line, s(q)).offset.squaredNorm();
  return std::sqrt(sum / std::max<double>(1, double(points.size())));
}

Registration register_by_palate(const Model& model, const TongueReach& reach,
                                const std::vector<Vec2>& palate_trace,
                                const std::vector<std::vector<Vec2>>& contours,
                                const HeadMarks& marks) {
  if (!model.palate)
    throw InputError("registration needs a palate; the model file has none in [surfaces]");
  if (palate_trace.size() < 5)
    throw InputError("registration needs a palate trace of at least 5 points");
  const auto cut = midsagittal_cut(*at_anatomy(model)->palate);
  if (cut.empty()) throw InputError("the model's palate does not cross the midsagittal plane");
  RegistrationProblem problem = problem_of(reach, contours, marks);
  problem.palate.assign(cut.front().begin(), cut.front().end());
  problem.trace = thin(palate_trace, enough_trace);
  problem.weight = contours_weight;
  for (const Vec2& q : palate_trace) problem.centre += q / double(palate_trace.size());
  std::vector<Vec2> middles;  // where on the palate the trace's middle may lie
  for (double along : {0.2, 0.35, 0.5, 0.65})
    middles.push_back(problem.palate[size_t(along * double(problem.palate.size() - 1))]);
  Registration result = best_of(reach, problem, middles);
  result.palate_rms = rms_distance(result.transform, palate_trace, problem.palate);
  return result;
}

Registration register_by_contours(const TongueReach& reach,
                                  const std::vector<std::vector<Vec2>>& contours,
                                  const HeadMarks& marks) {
  RegistrationProblem problem = problem_of(reach, contours, marks);
  problem.weight = alone_weight;
  size_t count = 0;
  for (const auto& c : contours) {
    for (const Vec2& q : c) problem.centre += q;
    count += c.size();
  }
  if (count < 5) throw InputError("an alignment by contours needs at least 5 points");
  problem.centre /= double(count);
  std::vector<Vec2> middles;
  for (double along : {0.3, 0.4, 0.5, 0.6})
    middles.push_back(reach.rest[size_t(along * double(reach.rest.size() - 1))]);
  return best_of(reach, problem, middles);
}

}  // namespace genio
