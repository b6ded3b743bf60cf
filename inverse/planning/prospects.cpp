#include "inverse/planning/prospects.hpp"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <random>

#include "inverse/posterior/posterior.hpp"
#include "inverse/prior/base/prior_rows.hpp"
#include "inverse/shape/settled_posterior.hpp"

namespace genio {
namespace {

constexpr double least_sd = 1e-6;  // of an eigenvalue that rounding makes negative

/// A truth, and what it makes of the residuals that were measured.
struct Draw {
  Vector unknowns;  ///< all
  Vector forces;    ///< the same with what a newton does not do as the model has it
  unsigned seed;    ///< of the noise
};

/// The answer's surroundings, once for all candidates.
struct Scene {
  const Model& model;
  const Prior& prior;
  const std::vector<Unknown>& unknowns;
  const PriorTerms& terms;
  const ModelError& error;
  const ObjectivePoint& point;
  Vec2 middle;  ///< that a head pose turns about
  double way;   ///< of the line from rest [m]
};

/// Rows of two sets of residuals, one after the other.
Residuals joined(Residuals a, const Residuals& b) {
  const auto stack = [](auto& into, const auto& more) {
    const Eigen::Index before = into.rows();
    into.conservativeResize(before + more.rows(), into.cols());
    into.bottomRows(more.rows()) = more;
  };
  const int points = int(a.places.size());
  stack(a.values, b.values), stack(a.distances, b.distances), stack(a.pose, b.pose);
  a.gradient.insert(a.gradient.end(), b.gradient.begin(), b.gradient.end());
  a.places.insert(a.places.end(), b.places.begin(), b.places.end());
  for (Residuals::Row row : b.rows) row.point += points, a.rows.push_back(row);
  return a;
}

/// A such that A A^T is the covariance.
Matrix root_of(const Matrix& covariance) {
  const Eigen::SelfAdjointEigenSolver<Matrix> eigen(covariance);
  const Vector sd = eigen.eigenvalues().cwiseMax(least_sd * least_sd).cwiseSqrt();
  return eigen.eigenvectors() * sd.asDiagonal();
}

Vector white_noise(Eigen::Index count, std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  Vector v(count);
  for (double& x : v) x = normal(random);
  return v;
}

/// What a candidate's points would read, as residuals at the scene's point.
class Readings {
 public:
  Readings(const Scene& scene, const Target& points) : scene_(scene), measured_(scene.point) {
    old_ = measured_.residuals.values.size();
    if (points.empty()) return;
    Comparison comparison(scene.model, points);
    comparison.turn_about(scene.middle);
    const Residuals fresh =
        comparison(scene.point.equilibrium.x, head_pose(scene.unknowns, scene.point.activations));
    const Matrix by = residual_jacobian(fresh, scene.point.positions) +
                      fresh.pose * pose_derivative(scene.unknowns);
    measured_.residuals = joined(measured_.residuals, fresh);
    measured_.jacobian.conservativeResize(old_ + by.rows(), by.cols());
    measured_.jacobian.bottomRows(by.rows()) = by;
    const Matrix scatter = residual_covariance(measured_.residuals, scene.error, scene.way);
    const Matrix old = scatter.topLeftCorner(old_, old_);
    told_ = old.llt().solve(scatter.topRightCorner(old_, by.rows())).transpose();
    left_ = root_of(scatter.bottomRightCorner(by.rows(), by.rows()) -
                    told_ * scatter.topRightCorner(old_, by.rows()));
  }

  Eigen::Index count() const { return measured_.residuals.values.size() - old_; }

  /// With the readings that the draw makes.
  const ObjectivePoint& under(const Draw& draw, std::mt19937_64& random) {
    if (count() == 0) return measured_;
    const Vector off = measured_.jacobian * (draw.unknowns - scene_.point.activations);
    const Vector erred = scene_.point.residuals.values + off.head(old_);
    measured_.residuals.values.tail(count()) =
        told_ * erred + left_ * white_noise(count(), random) - off.tail(count());
    return measured_;
  }

 private:
  const Scene& scene_;
  ObjectivePoint measured_;
  Eigen::Index old_ = 0;
  Matrix told_, left_;  ///< of new residuals given the old ones: mean, root of covariance
};

/// The unknown that is that parameter. Throws InputError where it is not estimated along.
size_t parameter_row(const std::vector<Unknown>& unknowns, const std::string& name) {
  for (size_t i = 0; i < unknowns.size(); ++i)
    if (unknowns[i].kind == Unknown::Kind::parameter && unknowns[i].name == name) return i;
  throw InputError(
      fmt::format("{}: is taken as known; name it under [parameter] in the prior file, with the "
                  "standard deviation that is believed of it",
                  name));
}

/// The prior with what the candidate would tell of single unknowns.
PriorTerms told_terms(const Scene& scene, const FurtherMeasurement& candidate, const Draw& draw,
                      std::mt19937_64& random) {
  if (candidate.emg_sd.empty() && candidate.parameter_sd.empty()) return scene.terms;
  std::normal_distribution<double> normal;
  Prior prior = scene.prior;
  for (const auto& [name, sd] : candidate.emg_sd)
    for (const Eigen::Index i : muscles_named(scene.unknowns, name, "EMG of")) {
      const double read = draw.forces[i] + sd * normal(random);
      prior.emg[scene.unknowns[size_t(i)].name] = {std::clamp(read, 0.0, 1.0), sd};
    }
  PriorTerms terms = prior_terms(prior, scene.unknowns);
  for (const auto& [name, sd] : candidate.parameter_sd) {
    const size_t i = parameter_row(scene.unknowns, name);
    const Unknown& u = scene.unknowns[i];
    const double z = draw.unknowns[Eigen::Index(i)];
    const double width = sd / std::abs(u.slope(u.value(z)));  // in z
    terms.rows.conservativeResize(terms.rows.rows() + 1, Eigen::NoChange);
    terms.rows.bottomRows(1).setZero();
    terms.rows(terms.rows.rows() - 1, Eigen::Index(i)) = 1 / width;
    terms.values.conservativeResize(terms.values.size() + 1);
    terms.values[terms.values.size() - 1] = z / width + normal(random);
  }
  return terms;
}

std::vector<Doubt> doubts(const ActingPosterior& posterior, const Scene& scene) {
  std::vector<Doubt> result;
  const auto& [values, weights] = posterior.samples;
  for (size_t i = 0; i < scene.unknowns.size(); ++i) {
    const Unknown& u = scene.unknowns[i];
    if (u.kind != Unknown::Kind::muscle) continue;
    const auto at = std::find(posterior.which.begin(), posterior.which.end(), Eigen::Index(i));
    Doubt& doubt = result.emplace_back();
    if (at == posterior.which.end()) continue;  // held
    const auto f = at - posterior.which.begin();
    const double upper = scene.terms.upper[Eigen::Index(i)];
    const bool rests = posterior.belief.slab[f] > 0;
    const ActingSummary s =
        rests ? summarise_acting(values.row(f), weights, upper)
              : ActingSummary{1, summarise(values.row(f), weights,
                                           scene.terms.lower[Eigen::Index(i)], upper)};
    doubt = {u.scale * (s.force.high - s.force.low), std::min(s.acts, 1 - s.acts)};
  }
  return result;
}

/// Truths by their weights, at equal steps of the cumulated weight.
std::vector<Draw> draws_of(const ActingPosterior& narrow, const ActingPosterior& wide,
                           const Vector& at, int count) {
  std::vector<Draw> draws;
  std::mt19937_64 random(20261130);
  double sum = 0;
  Eigen::Index k = 0;
  const Vector& weights = narrow.samples.weights;
  for (int d = 0; d < count; ++d) {
    const double wanted = (d + 0.5) / count;
    while (k + 1 < weights.size() && sum + weights[k] < wanted) sum += weights[k++];
    Draw draw{at, at, unsigned(random())};
    draw.unknowns(narrow.which) = narrow.samples.values.col(k);
    draw.forces(narrow.which) = wide.samples.values.col(k);
    draws.push_back(std::move(draw));
  }
  return draws;
}

Prospect prospect(const Scene& scene, const FurtherMeasurement& candidate,
                  const std::vector<Draw>& draws, const Prospects& all) {
  Readings readings(scene, candidate.points);
  Prospect result{candidate.name, readings.count(), std::vector<Doubt>(all.muscles.size())};
  for (const auto* told : {&candidate.emg_sd, &candidate.parameter_sd})
    result.values += Eigen::Index(told->size());
  for (const Draw& draw : draws) {
    std::mt19937_64 random(draw.seed);
    const ObjectivePoint& point = readings.under(draw, random);
    const PriorTerms terms = told_terms(scene, candidate, draw, random);
    const auto left =
        doubts(acting_posterior(point, scene.unknowns, terms, scene.error, scene.way), scene);
    for (size_t m = 0; m < left.size(); ++m) {
      result.muscles[m].width += left[m].width / double(draws.size());
      result.muscles[m].acts += left[m].acts / double(draws.size());
      result.widths.push_back(left[m].width);
    }
  }
  double before = 0, after = 0;
  for (size_t m = 0; m < all.muscles.size(); ++m)
    before += all.before[m].width / all.maximum[m],
        after += result.muscles[m].width / all.maximum[m];
  result.gain = before > 0 ? 1 - after / before : 0;
  return result;
}

}  // namespace

Prospects prospects(const Model& model, const Target& target, const Prior& prior,
                    const Answer& answer, const std::vector<FurtherMeasurement>& candidates,
                    Workspace& ws, const InferOptions& options, const ProspectOptions& how) {
  InferOptions from = options;
  start_from(answer, from);
  const Comparison comparison(model, target);
  Objective objective(model, comparison, prior, from, ws);
  const ObjectivePoint* optimum = objective.derivatives(answer.activations);
  if (!optimum) throw InputError("no equilibrium at the answer: " + objective.last_failure());
  const ObjectivePoint at = *optimum;
  const SettledPosterior settled =
      settled_posterior(objective, at, comparison, options.model_error);
  const Scene scene{model,
                    prior,
                    objective.unknowns(),
                    objective.prior(),
                    options.model_error,
                    settled.point,
                    comparison.middle(),
                    displacement_from_rest(comparison, settled.point.equilibrium.x)};
  ModelError alone = options.model_error;  // without what spreads forces
  alone.efficacy_sd = alone.efficacy_by_way = 0;
  const ActingPosterior narrow =
      acting_posterior(settled.point, scene.unknowns, scene.terms, alone, scene.way);
  const auto draws = draws_of(narrow, settled.posterior, settled.point.activations, how.draws);

  Prospects result;
  for (const Unknown& u : scene.unknowns)
    if (u.kind == Unknown::Kind::muscle)
      result.muscles.push_back(u.name), result.maximum.push_back(u.scale);
  result.before = doubts(settled.posterior, scene);
  for (const FurtherMeasurement& candidate : candidates) {
    result.further.push_back(prospect(scene, candidate, draws, result));
    if (how.progress) how.progress(int(result.further.size()), int(candidates.size()));
  }
  return result;
}

}  // namespace genio
