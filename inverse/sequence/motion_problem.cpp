#include "inverse/sequence/motion_problem.hpp"

#include <cmath>

#include "forward/statics/sensitivity.hpp"
#include "inverse/shape/curvature.hpp"
#include "inverse/target/comparison.hpp"
#include "inverse/target/head_pose.hpp"

namespace genio {

std::vector<double> MotionProblem::knots(double last, double apart) {
  const int pieces = std::max(1, int(std::lround(last / apart)));
  std::vector<double> result;
  for (int j = 0; j <= pieces; ++j) result.push_back(last * j / pieces);
  return result;
}

MotionProblem::MotionProblem(const Model& model, const std::vector<MotionFrame>& frames,
                             const Prior& prior, const MotionOptions& options, Workspace& ws)
    : model_(model),
      frames_(frames),
      options_(options),
      ws_(ws),
      sensitivity_ws_(model),
      unknowns_(unknowns_of(model, prior, *options.infer.bilateral)),
      base_(default_parameters(model)),
      clock_(options.infer) {
  for (const Unknown& c : unknowns_) {
    auto& combination = controls_.combinations.emplace_back();
    for (size_t i = 0; i < c.parameters.size(); ++i)
      combination.push_back({c.parameters[i], c.scale * c.shares[i]});
  }
  controls_.knots = knots(frames.back().time_s, options.knot_s);
  for (const MotionFrame& f : frames) comparisons_.emplace_back(model, f.target);
  set_prior(prior);
}

void MotionProblem::set_prior(const Prior& prior) {
  const size_t count = controls_.knots.size();
  std::vector<double> steps(count, 1);
  for (size_t j = 1; j < count; ++j)
    steps[j] = walk_sd(prior, controls_.knots[j - 1], controls_.knots[j]);
  terms_ = prior_terms(prior, unknowns_);
  prior_ = chained(std::vector(count, terms_), steps, std::vector<bool>(unknowns_.size(), true));
  if (!options_.from_rest) return;
  for (size_t c = 0; c < unknowns_.size(); ++c) {
    const Unknown& unknown = unknowns_[c];
    const auto at = Eigen::Index(c);
    prior_.lower[at] = prior_.upper[at] = unknown.kind == Unknown::Kind::muscle
                                              ? 0
                                              : base_[unknown.parameters.front()] / unknown.scale;
  }
}

Vector MotionProblem::values() const {
  Eigen::Index count = 0;
  for (const Residuals& r : residuals_) count += r.values.size();
  Vector all(count);
  Eigen::Index first = 0;
  for (const Residuals& r : residuals_) {
    all.segment(first, r.values.size()) = r.values;
    first += r.values.size();
  }
  return all;
}

double MotionProblem::rms() const {
  double sum = 0, count = 0;
  for (const Residuals& r : residuals_)
    sum += r.distances.squaredNorm(), count += double(r.distances.size());
  return count > 0 ? std::sqrt(sum / count) : 0;
}

std::optional<Equilibrium> MotionProblem::start_of(const Vector& u) {
  const Parameters p = apply_unknowns(unknowns_, u.head(Eigen::Index(unknowns_.size())), base_);
  if (start_ && start_->parameters == p) return start_;
  const Equilibrium e =
      solve_equilibrium(model_, p, start_ ? start_->x : model_.rest, sensitivity_ws_);
  if (!e) {
    failure_ = "the motion's start: " + e.message;
    return {};
  }
  return start_ = e;
}

std::optional<double> MotionProblem::value(const Vector& u) {
  if (at_.size() == u.size() && at_ == u) return value_;
  if (stopped()) return {};
  const auto start = start_of(u);
  if (!start) return {};
  TimeOptions time = options_.time;
  time.duration = frames_.back().time_s;
  ++simulations_;
  Trajectory t = simulate(model_, controls_.over_time(u, base_), start->x, ws_, time);
  if (!t) {
    failure_ = t.message;
    return {};
  }
  std::vector<Residuals> residuals;
  double value = prior_.all.value(u);
  for (size_t k = 0; k < frames_.size(); ++k) {
    residuals.push_back(comparisons_[k](shape_at(t, frames_[k].time_s)));
    value += 0.5 * residuals.back().values.squaredNorm();
  }
  at_ = u, trajectory_ = std::move(t), residuals_ = std::move(residuals), value_ = value;
  return value;
}

std::shared_ptr<LocalModel> MotionProblem::local(const Vector& u) {
  auto local = local_problem(u);
  if (local && options_.checkpoint)
    options_.checkpoint(by_point(u, Eigen::Index(unknowns_.size())));
  return local;
}

std::shared_ptr<LocalProblem> MotionProblem::local_problem(const Vector& u) {
  if (local_ && local_->anchor() == u) return local_;
  if (!value(u)) return nullptr;
  const auto n = Eigen::Index(unknowns_.size());
  Matrix first;
  if (!options_.from_rest) {
    first = Matrix::Zero(model_.rest.size(), controls_.unknowns());
    const Matrix by_first = sensitivity_to_forces(
        model_, *start_, force_by_unknown(model_, unknowns_, start_->x, start_->parameters),
        sensitivity_ws_);
    if (by_first.size() == 0) {
      failure_ = "the motion starts at an unstable equilibrium";
      return nullptr;
    }
    first.leftCols(n) = by_first + held_by_unknown(model_, unknowns_, start_->parameters);
  }
  std::vector<double> times;
  for (const MotionFrame& f : frames_) times.push_back(f.time_s);
  const auto positions =
      motion_sensitivity(model_, controls_, controls_.over_time(u, base_), trajectory_,
                         options_.time.scheme, first, times, sensitivity_ws_);
  if (positions.empty()) {
    failure_ = "a step of the motion has no stable tangent";
    return nullptr;
  }
  std::vector<LocalShape> shapes;
  for (size_t k = 0; k < frames_.size(); ++k) {
    std::vector<int> moving;
    for (Eigen::Index c = 0; c < u.size(); ++c)
      if (!positions[k].col(c).isZero(0)) moving.push_back(int(c));
    shapes.emplace_back(comparisons_[k], shape_at(trajectory_, times[k]),
                        positions[k](Eigen::all, moving), HeadPose{},
                        Matrix::Zero(3, Eigen::Index(moving.size())), moving);
  }
  local_ = std::make_shared<LocalProblem>(std::move(shapes), prior_.all, u);
  return local_;
}

}  // namespace genio
