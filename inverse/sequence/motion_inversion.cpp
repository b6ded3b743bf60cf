#include "inverse/sequence/motion_inversion.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "inverse/sequence/motion_posterior.hpp"
#include "inverse/shape/settled_posterior.hpp"
#include "inverse/shape/summary.hpp"
#include "inverse/target/comparison.hpp"

namespace genio {
namespace {

constexpr double static_part = 0.15;  // of the work: the answers without motion

void check(const Model& model, const std::vector<MotionFrame>& frames, const Prior& prior) {
  if (frames.empty()) throw InputError("a movement needs at least one frame");
  double last = 0;
  for (size_t k = 0; k < frames.size(); ++k) {
    if (frames[k].target.empty()) throw InputError(fmt::format("frame {}: has no points", k + 1));
    if (!(frames[k].time_s > last))
      throw InputError(
          fmt::format("frame {}: time {} s; a movement starts at 0, and its frames rise in time",
                      k + 1, frames[k].time_s));
    last = frames[k].time_s;
  }
  if (prior.head_pose)
    throw InputError("dynamic inversion takes the head pose as given: leave [head_pose] out");
  if (!find_effect(model, "viscosity"))
    throw InputError(model.name + ": a movement needs [effect.viscosity] in the model");
}

/// Unknowns at each knot, linear in time between the static answers of the frames.
Vector static_start(const Model& model, const std::vector<MotionFrame>& frames, const Prior& prior,
                    InferWorkspace& ws, const MotionOptions& o, const MotionProblem& problem) {
  const auto n = Eigen::Index(problem.unknowns().size());
  std::vector<double> times;
  std::vector<Vector> answers;
  if (o.from_rest) times.push_back(0), answers.push_back(problem.lower().head(n));
  InferOptions infer = o.infer;
  for (const MotionFrame& f : frames) {
    const Answer a = infer_from_starts(model, f.target, prior, ws, infer, {1});
    if (a.status != InferStatus::converged) continue;
    times.push_back(f.time_s), answers.push_back(a.activations);
    start_from(a, infer);
    if (o.progress)
      o.progress(static_part * double(times.size()) / double(frames.size() + 1), "without motion");
  }
  const auto& knots = problem.controls().knots;
  Vector u = Vector::Zero(problem.controls().unknowns());
  if (answers.empty()) return u;
  const CommandsOverTime between{std::move(times), std::move(answers)};
  for (size_t j = 0; j < knots.size(); ++j)
    u.segment(n * Eigen::Index(j), n) = between.at(knots[j]);
  return u;
}

/// The verdict of all frames together, by the fit of all knots' unknowns, and which bounds press.
struct MotionFit {
  FitTest test;
  std::vector<int> side;  ///< of each unknown, see pressed(); 0: none, or it is fixed
};

MotionFit fit_of(MotionProblem& problem, const Vector& u, const ModelError& error) {
  MotionFit fit{{}, std::vector<int>(size_t(u.size()), 0)};
  std::vector<Eigen::Index> open, free;
  for (Eigen::Index i = 0; i < u.size(); ++i)
    if (problem.lower()[i] < problem.upper()[i]) open.push_back(i);
  LocalProblem& local = *problem.local_problem(u);
  const Matrix h = Eigen::SparseMatrix<double>(local.hessian(u).selfadjointView<Eigen::Lower>());
  Vector slope;
  local.gradient(u, slope);
  const Matrix j = local.jacobian(u);
  const BoxGaussian narrow{u(open), slope(open), h(open, open), problem.lower()(open),
                           problem.upper()(open)};
  for (size_t f = 0; f < open.size(); ++f) {
    fit.side[size_t(open[f])] = pressed(narrow, Eigen::Index(f));
    if (fit.side[size_t(open[f])] == 0) free.push_back(open[f]);
  }
  Matrix scatter = Matrix::Identity(j.rows(), j.rows());
  Eigen::Index first = 0;
  for (size_t k = 0; k < problem.residuals().size(); ++k) {
    const Residuals& r = problem.residuals()[k];
    const auto rows = Eigen::seqN(first, r.values.size());
    const Comparison& comparison = problem.comparisons()[k];
    const Positions x = problem.shape(k);
    scatter(rows, rows) += unabsorbed_error(r, error, displacement_from_rest(comparison, x),
                                            ways_from_rest(r, x, comparison.rest()));
    first += r.values.size();
  }
  const Matrix j_free = j(Eigen::all, free);
  const double used =
      free.empty() ? 0.0 : (j_free * Matrix(h(free, free)).llt().solve(j_free.transpose())).trace();
  fit.test = test_fit(problem.values(), scatter, used,
                      slope(open).dot(Matrix(h(open, open)).llt().solve(slope(open))));
  return fit;
}

/// Verdict, estimates and joint statements of an answer whose optimum is u. False where the
/// posterior cannot be had.
bool summarise(MotionProblem& problem, const Vector& u, const ModelError& error,
               MotionAnswer& answer) {
  const MotionFit fit = fit_of(problem, u, error);
  const auto posteriors = motion_posterior(problem, u, error);
  if (posteriors.empty()) return false;
  const auto n = Eigen::Index(problem.unknowns().size());
  for (size_t knot = 0; knot < posteriors.size(); ++knot) {
    const Eigen::Index first = n * Eigen::Index(knot);
    Answer here;
    set_estimates(problem.unknowns(), terms_at(problem, knot), posteriors[knot],
                  u.segment(first, n), here);
    auto& all = answer.estimates.emplace_back(std::move(here.muscles));
    all.insert(all.end(), here.others.begin(), here.others.end());
    for (Eigen::Index i = 0; i < n; ++i) {
      const int side = fit.side[size_t(first + i)];
      all[size_t(i)].at_lower = side<0, all[size_t(i)].at_upper = side> 0;
    }
    answer.joint.push_back(std::move(here.joint));
  }
  answer.chi2_per_dof = fit.test.chi2_per_dof, answer.verdict = fit.test.verdict;
  answer.message =
      fmt::format("misfit {} noise (p = {:.2g})",
                  fit.test.verdict == Verdict::explained ? "within" : "beyond", fit.test.tail);
  return true;
}

MotionAnswer unfolded(const Mirror& mirror, MotionAnswer answer) {
  for (auto& knot : answer.estimates) double_forces(knot);
  for (auto& knot : answer.joint) double_forces(knot);
  for (auto& f : answer.frames) f.shape = mirror.whole(f.shape);
  for (Instant& i : answer.trajectory.instants) {
    i.x = mirror.whole(i.x), i.velocity = mirror.whole(i.velocity);
    i.acceleration = mirror.whole(i.acceleration);
    i.kinetic *= 2, i.potential *= 2, i.dissipated *= 2, i.work_done *= 2;
  }
  return answer;
}

}  // namespace

MotionAnswer infer_motion(const Model& model, const std::vector<MotionFrame>& frames,
                          const Prior& prior, InferWorkspace& ws, const MotionOptions& options) {
  ws.check(model);
  check(model, frames, prior);
  MotionOptions o = options;
  const auto all = [&](auto what) { return std::all_of(frames.begin(), frames.end(), what); };
  o.infer.bilateral = options.infer.bilateral.value_or(
      all([](const MotionFrame& f) { return f.target.midsagittal(); }));
  TongueState* half =
      all([&](const MotionFrame& f) { return fits_half_tongue(f.target, prior, o.infer); })
          ? ws.half(prior)
          : nullptr;
  TongueState& tongue = half ? *half : ws.whole();
  std::vector<MotionFrame> own = frames;
  if (half)
    for (MotionFrame& f : own) f.target = half_target(ws.mirror(), f.target);
  MotionAnswer answer;
  const int before = tongue.workspace.cholesky.factorizations();
  MotionProblem problem(*tongue.model, own, half ? half_prior(prior) : prior, o, tongue.workspace);
  const auto n = Eigen::Index(problem.unknowns().size());
  answer.knots_s = problem.controls().knots;
  Vector start(problem.controls().unknowns());
  if (fits(o.known, answer.knots_s.size(), n))
    for (size_t j = 0; j < o.known.size(); ++j) start.segment(n * Eigen::Index(j), n) = o.known[j];
  else start = static_start(model, frames, prior, ws, o, problem);
  start = start.cwiseMax(problem.lower()).cwiseMin(problem.upper());

  DescentOptions how{o.infer.max_iterations, 1e-3, {}};
  how.progress = [&](int step, double rms) {
    if (o.progress)
      o.progress(1 - (1 - static_part) * std::pow(0.6, step),
                 fmt::format("step {}, RMS {:.2f} mm", step, 1e3 * rms));
  };
  const DescentResult r = descend(problem, start, how);
  answer.iterations = r.solver_iterations;
  answer.message = r.message;
  if (r.converged) {
    // A trial may have been the latest motion.
    const bool again = problem.value(r.u) && problem.local_problem(r.u);
    if (again) {
      answer.trajectory = problem.trajectory(), answer.rms = problem.rms();
      for (size_t k = 0; k < own.size(); ++k)
        answer.frames.push_back(
            {own[k].time_s, shape_at(answer.trajectory, own[k].time_s), problem.residuals()[k]});
      answer.unknowns = by_point(r.u, n);
    }
    if (again && summarise(problem, r.u, o.infer.model_error, answer))
      answer.status = InferStatus::converged;
    else answer.message = problem.last_failure();
  } else if (problem.stopped()) {
    answer.status = problem.stop_reason();
    answer.message = answer.status == InferStatus::deadline ? "the deadline passed"
                                                            : "cancelled by the requester";
  }
  answer.simulations = problem.simulations();
  answer.factorizations = tongue.workspace.cholesky.factorizations() - before;
  answer.wall_s = problem.seconds();
  return half ? unfolded(ws.mirror(), std::move(answer)) : answer;
}

}  // namespace genio
