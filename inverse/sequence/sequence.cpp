#include "inverse/sequence/sequence.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <mutex>
#include <thread>

#include "forward/base/elapsed.hpp"
#include "inverse/sequence/sequence_problem.hpp"
#include "inverse/shape/summary.hpp"

namespace genio {
namespace {

constexpr double first_pass = 0.5;  // its part of the work, about

struct Reporter {
  std::function<void(double, const std::string&)> progress;
  void operator()(double part, const std::string& what) const {
    if (progress) progress(part, what);
  }
};

/// The first frame of each thread's run of neighbours.
std::vector<size_t> groups_of(size_t frames, int threads) {
  const size_t count = std::clamp<size_t>(size_t(std::max(1, threads)), 1, frames);
  std::vector<size_t> first;
  for (size_t g = 0; g < count; ++g) first.push_back(frames * g / count);
  return first;
}

/// Frame by frame, each near the one before.
std::vector<Answer> walk_through(const Model& model, const std::vector<SequenceFrame>& frames,
                                 const Prior& prior, InferWorkspace& ws, const SequenceOptions& o,
                                 const std::vector<size_t>& groups, const Reporter& report) {
  std::vector<Answer> answers(frames.size());
  std::mutex turn;
  size_t done = 0;
  const auto work = [&](size_t g, InferWorkspace& own) {
    InferOptions infer = o.infer;
    double last = 0;
    const size_t end = g + 1 < groups.size() ? groups[g + 1] : frames.size();
    for (size_t k = groups[g]; k < end; ++k) {
      Prior here = prior;
      if (infer.start.size() > 0)
        here.before = Prior::Before{infer.start, walk_sd(prior, last, frames[k].time_s)};
      answers[k] = infer_from_starts(model, frames[k].target, here, own, infer, o.starts);
      if (answers[k].status == InferStatus::converged) {
        start_from(answers[k], infer);
        last = frames[k].time_s;
      }
      const std::lock_guard lock(turn);
      report(first_pass * double(++done) / double(frames.size()), "frame by frame");
    }
  };
  std::vector<std::jthread> threads;
  for (size_t g = 1; g < groups.size(); ++g)
    threads.emplace_back([&, g] {
      InferWorkspace own(model);
      work(g, own);
    });
  work(0, ws);
  return answers;
}

/// What one side of a chain says of a frame: precision, and slope at the optimum.
struct Message {
  Matrix precision;
  Vector slope;
};

/// Adds it to the prior of a frame whose optimum is z.
void add(const Message& m, const Vector& z, PriorTerms& terms) {
  const Eigen::SelfAdjointEigenSolver<Matrix> eigen(m.precision);
  // Rows R with R^T R = precision, and values so that the slope R^T (R z - v) is the message's.
  const Vector root = eigen.eigenvalues().cwiseMax(0).cwiseSqrt();
  const Matrix rows = root.asDiagonal() * eigen.eigenvectors().transpose();
  const Vector inverse = (root.array() > 1e-9).select(1 / root.array().max(1e-9), 0);
  const Vector values =
      rows * z - Vector(inverse.asDiagonal() * (eigen.eigenvectors().transpose() * m.slope));
  Matrix all(terms.rows.rows() + rows.rows(), rows.cols());
  all << terms.rows, rows;
  Vector all_values(terms.values.size() + values.size());
  all_values << terms.values, values;
  terms.rows = std::move(all), terms.values = std::move(all_values);
}

/// Precision that a chain ending in `precision` gives across a step: (P^-1 + sd^2)^-1 over the
/// unknowns that walk, those that a bound holds with no spread of their own.
Matrix across(const Matrix& precision, const std::vector<Eigen::Index>& free,
              const std::vector<bool>& walks, double sd) {
  const auto n = precision.rows();
  Matrix spread = Matrix::Zero(n, n);
  const Matrix inner = precision(free, free);
  const Matrix inverse = inner.ldlt().solve(Matrix::Identity(inner.rows(), inner.cols()));
  for (size_t i = 0; i < free.size(); ++i)
    for (size_t j = 0; j < free.size(); ++j)
      spread(free[i], free[j]) = inverse(Eigen::Index(i), Eigen::Index(j));
  spread.diagonal().array() += sd * sd;
  Matrix result = spread.ldlt().solve(Matrix::Identity(n, n));
  for (Eigen::Index i = 0; i < n; ++i)
    if (!walks[size_t(i)]) result.row(i).setZero(), result.col(i).setZero();
  return 0.5 * (result + result.transpose());
}

std::vector<Eigen::Index> free_of(const ObjectivePoint& p, const Vector& lower,
                                  const Vector& upper) {
  std::vector<Eigen::Index> free;
  for (Eigen::Index i = 0; i < lower.size(); ++i)
    if (p.activations[i] > lower[i] && p.activations[i] < upper[i]) free.push_back(i);
  return free;
}

/// Each frame's answer with its neighbours' say as its prior.
void summarise(std::vector<std::unique_ptr<JointFrame>>& frames, const SequenceProblem& problem,
               const Vector& u, std::vector<Answer>& answers) {
  const size_t count = frames.size();
  std::vector<const ObjectivePoint*> points;
  std::vector<Matrix> own;
  std::vector<std::vector<Eigen::Index>> free;
  for (size_t k = 0; k < count; ++k) {
    Objective& o = frames[k]->objective;
    points.push_back(o.derivatives(problem.unknowns_of(u, k)));
    if (!points.back()) {
      answers[k].message = o.last_failure();
      return;
    }
    own.push_back(o.gauss_newton(*points[k]));
    free.push_back(free_of(*points[k], o.lower(), o.upper()));
  }
  const auto n = own.front().rows();
  std::vector<Matrix> left(count, Matrix::Zero(n, n)), right = left;
  for (size_t k = 1; k < count; ++k)
    left[k] = across(own[k - 1] + left[k - 1], free[k - 1], problem.walks(), frames[k]->walk_sd);
  for (size_t k = count - 1; k-- > 0;)
    right[k] =
        across(own[k + 1] + right[k + 1], free[k + 1], problem.walks(), frames[k + 1]->walk_sd);
  for (size_t k = 0; k < count; ++k) {
    Objective& o = frames[k]->objective;
    const auto slopes = problem.walk_slopes(u, k);
    PriorTerms terms = o.prior();
    const Vector& z = points[k]->activations;
    if (k > 0) add({left[k], slopes.first}, z, terms);
    if (k + 1 < count) add({right[k], slopes.second}, z, terms);
    o.set_prior(std::move(terms));
    Answer& a = answers[k];
    set_optimum(*points[k], a);
    summarise_posterior(o, *points[k], frames[k]->comparison, frames[k]->options.model_error, a);
  }
}

}  // namespace

std::vector<Answer> infer_sequence(const Model& model, const std::vector<SequenceFrame>& all,
                                   const Prior& prior, InferWorkspace& ws,
                                   const SequenceOptions& o) {
  ws.check(model);
  const Reporter report{o.progress};
  std::vector<Answer> result(all.size());
  std::vector<SequenceFrame> frames;
  std::vector<size_t> place;
  for (size_t k = 0; k < all.size(); ++k) {
    result[k].message = "the frame has no points";
    if (!all[k].target.empty()) frames.push_back(all[k]), place.push_back(k);
  }
  if (frames.empty()) throw InputError("no frame of the sequence has a point");
  // One recording, one set of unknowns.
  SequenceOptions how = o;
  how.infer.bilateral = o.infer.bilateral.value_or(std::all_of(
      frames.begin(), frames.end(), [](const SequenceFrame& f) { return f.target.midsagittal(); }));
  const bool symmetric = std::all_of(frames.begin(), frames.end(), [&](const SequenceFrame& f) {
    return fits_half_tongue(f.target, prior, how.infer);
  });
  const Stopwatch watch;
  const auto n = Eigen::Index(unknowns_of(model, prior, *how.infer.bilateral).size());
  auto groups = groups_of(frames.size(), o.threads);
  std::vector<Answer> answers(frames.size());
  const bool known = fits(o.known, frames.size(), n);
  if (!known) answers = walk_through(model, frames, prior, ws, how, groups, report);
  // Frames without a first answer have no place in the joint problem.
  std::vector<size_t> kept;
  for (size_t k = 0; k < frames.size(); ++k)
    if (known || answers[k].status == InferStatus::converged) kept.push_back(k);
  for (size_t k = 0; k < frames.size(); ++k) result[place[k]] = answers[k];
  if (kept.empty()) return result;

  TongueState* half = symmetric ? ws.half(prior) : nullptr;
  const Model& tongue = half ? *half->model : model;
  const Prior own = half ? half_prior(prior) : prior;
  groups = groups_of(kept.size(), o.threads);
  std::vector<std::unique_ptr<Workspace>> workspaces;
  for (size_t g = 0; g < groups.size(); ++g)
    workspaces.push_back(std::make_unique<Workspace>(tongue));
  std::vector<std::unique_ptr<JointFrame>> joint;
  Vector start(n * Eigen::Index(kept.size()));
  for (size_t j = 0, g = 0; j < kept.size(); ++j) {
    const size_t k = kept[j];
    if (g + 1 < groups.size() && j == groups[g + 1]) ++g;
    InferOptions infer = how.infer;
    if (known) infer.start = o.known[k];
    else start_from(answers[k], infer);
    if (half) infer = half_options(ws.mirror(), infer);
    const double sd = j == 0 ? 1 : walk_sd(prior, frames[kept[j - 1]].time_s, frames[k].time_s);
    joint.push_back(std::make_unique<JointFrame>(
        tongue, half ? half_target(ws.mirror(), frames[k].target) : frames[k].target, own,
        std::move(infer), *workspaces[g], sd));
    start.segment(n * Eigen::Index(j), n) = joint.back()->options.start;
  }
  SequenceProblem problem(joint, groups);
  problem.accepted = [&](const Vector& u) {
    if (o.checkpoint && kept.size() == frames.size()) o.checkpoint(by_point(u, n));
  };
  DescentOptions descent{how.infer.max_iterations, how.infer.tolerance * double(kept.size()), {}};
  descent.progress = [&](int step, double) {
    report(1 - (1 - first_pass) * std::pow(0.6, step), "all frames together");
  };
  const DescentResult r =
      descend(problem, start.cwiseMax(problem.lower()).cwiseMin(problem.upper()), descent);
  std::vector<Answer> smooth(kept.size());
  if (r.converged) summarise(joint, problem, r.u, smooth);
  const double seconds = watch.seconds();
  for (size_t j = 0; j < kept.size(); ++j) {
    Answer& a = smooth[j];
    const Objective& objective = joint[j]->objective;
    if (r.converged && a.shape.size() > 0) a.status = InferStatus::converged;
    else if (problem.stopped()) a.status = objective.stop_reason(), a.message = "stopped";
    else if (a.message.empty()) a.message = r.message;
    a.iterations = answers[kept[j]].iterations + r.solver_iterations;
    a.factorizations = answers[kept[j]].factorizations;
    a.forward_solves = answers[kept[j]].forward_solves + objective.forward_solves();
    a.wall_s = seconds / double(kept.size());
    result[place[kept[j]]] = half ? whole_answer(ws.mirror(), std::move(a)) : std::move(a);
  }
  report(1, "done");
  return result;
}

}  // namespace genio
