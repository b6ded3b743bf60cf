#include "inverse/search/full_space.hpp"

#include <fmt/format.h>

#include <cmath>

#include "forward/model/at_anatomy.hpp"
#include "inverse/shape/curvature.hpp"
#include "inverse/shape/objective.hpp"
#include "inverse/shape/summary.hpp"
#include "inverse/target/comparison.hpp"
#include "inverse/target/comparison_curvature.hpp"

namespace genio {
namespace {

// Unknowns and constraints near 1: displacements in mm, forces in mN.
constexpr double length = 1e-3;      // [m]
constexpr double force_unit = 1e-3;  // [N]
constexpr double longest = 1e-6;     // displacement of differences [m]
constexpr int most_iterations = 100;
constexpr double near_enough = 1;  // fall of the objective still to be had

/// Unknowns: displacements of the free unknowns, then commands.
class FullSpace final : public NonlinearProgram {
 public:
  FullSpace(const Model& model, const Comparison& comparison, std::vector<Unknown> unknowns,
            PriorTerms prior, const InferOptions& options)
      : model_(model),
        comparison_(comparison),
        unknowns_(std::move(unknowns)),
        prior_(std::move(prior)),
        options_(options),
        base_(default_parameters(model)),
        by_pose_(pose_derivative(unknowns_)),
        free_(model.dofs.unknowns()),
        count_(Eigen::Index(unknowns_.size())),
        k_(model.pattern),
        other_(model.pattern),
        reduced_(*model.pattern, model.dofs),
        clock_(options) {
    lower_ = Vector::Constant(free_ + count_, -1e3), upper_ = -lower_;
    lower_.tail(count_) = prior_.lower, upper_.tail(count_) = prior_.upper;
    make_pattern();
  }

  Vector start(const Positions& x, const Vector& z) const {
    Vector v(free_ + count_);
    const auto here = at_anatomy(model_, apply_unknowns(unknowns_, z, base_));
    const Vector followed_way = followed(model_.dofs, here->rest - model_.rest);
    v << model_.dofs.pick(x - here->rest + followed_way) / length, z;
    return v;
  }
  /// Unknowns say where nodes are in space, so that only what is held goes with an anatomy.
  Positions shape(const Vector& v) const {
    const auto here = at_anatomy(model_, apply_unknowns(unknowns_, unknowns(v), base_));
    return here->rest - followed(model_.dofs, here->rest - model_.rest) +
           model_.dofs.expand(length * v.head(free_));
  }
  Vector unknowns(const Vector& v) const { return v.tail(count_); }
  WorkClock& clock() { return clock_; }

  const Vector& lower() const override { return lower_; }
  const Vector& upper() const override { return upper_; }
  bool value(const Vector& v, double& f) override {
    if (!evaluate(v)) return false;
    f = 0.5 * residuals_.values.squaredNorm() + prior_.value(unknowns(v));
    return true;
  }
  bool gradient(const Vector& v, Vector& g) override {
    if (!evaluate(v)) return false;
    g.resize(v.size());
    g << length * model_.dofs.reduce(misfit_gradient(residuals_, x_.size())),
        prior_.gradient(unknowns(v)) +
            held_by_unknown(model_, unknowns_, p_).transpose() *
                misfit_gradient(residuals_, x_.size()) +
            by_pose_.transpose() * (residuals_.pose.transpose() * residuals_.values);
    return true;
  }
  int constraints() const override { return int(free_); }
  bool constraint_values(const Vector& v, Vector& c) override {
    if (!evaluate(v)) return false;
    c = model_.dofs.reduce(force(model_, x_, p_)) / force_unit;
    return true;
  }
  Entries jacobian_entries() const override {
    Entries entries;
    each_lower([&](int row, int column, double) {
      entries.emplace_back(row, column);
      if (row != column) entries.emplace_back(column, row);
    });
    for (int c = 0; c < int(count_); ++c)
      for (int r = 0; r < int(free_); ++r) entries.emplace_back(r, int(free_) + c);
    return entries;
  }
  bool jacobian(const Vector& v, std::span<double> values) override {
    if (!evaluate(v)) return false;
    stiffness(model_, x_, p_, k_);
    reduced_.assign(k_);
    size_t at = 0;
    each_lower([&](int row, int column, double k) {
      values[at++] = -k * length / force_unit;
      if (row != column) values[at++] = -k * length / force_unit;
    });
    const Matrix pulls = force_by_unknown(model_, unknowns_, x_, p_);
    for (Eigen::Index c = 0; c < count_; ++c) {
      const Vector column = model_.dofs.reduce(pulls.col(c)) / force_unit;
      for (Eigen::Index r = 0; r < free_; ++r) values[at++] = column[r];
    }
    return true;
  }
  Entries hessian_entries() const override {
    Entries entries;
    for (Eigen::Index k = 0; k < hessian_.outerSize(); ++k)
      for (Eigen::SparseMatrix<double>::InnerIterator it(hessian_, k); it; ++it)
        entries.emplace_back(int(it.row()), int(it.col()));
    return entries;
  }
  bool hessian(const Vector& v, double factor, const Vector& multipliers,
               std::span<double> values) override;
  bool go_on(int iteration) override {
    if (options_.progress) options_.progress(iteration, residuals_.rms);
    return !clock_.stopped();
  }

 private:
  template <class Act>
  void each_lower(Act act) const {
    const auto& m = reduced_.lower();
    for (Eigen::Index c = 0; c < m.outerSize(); ++c)
      for (Eigen::SparseMatrix<double>::InnerIterator it(m, c); it; ++it)
        act(int(it.row()), int(it.col()), it.value());
  }
  bool evaluate(const Vector& v);
  void make_pattern();
  /// Adds to the lower triangle; nodal components and pose to the unknowns they stand for.
  void add(int row, int column, double value) {
    if (row >= column) hessian_.coeffRef(row, column) += value;
  }
  void add_nodal(int i, int j, double value);

  const Model& model_;
  const Comparison& comparison_;
  std::vector<Unknown> unknowns_;
  PriorTerms prior_;
  const InferOptions& options_;
  Parameters base_;
  Matrix by_pose_;
  Eigen::Index free_, count_;
  Stiffness k_, other_;
  ReducedStiffness reduced_;
  Vector lower_, upper_;
  Eigen::SparseMatrix<double> hessian_;
  Vector at_;
  bool good_ = false;
  Positions x_;
  Parameters p_;
  Residuals residuals_;
  WorkClock clock_;
};

bool FullSpace::evaluate(const Vector& v) {
  if (at_.size() == v.size() && at_ == v) return good_;
  at_ = v;
  p_ = apply_unknowns(unknowns_, unknowns(v), base_);
  try {
    x_ = shape(v);
  } catch (const InputError&) {  // an anatomy that nobody can have
    return good_ = false;
  }
  good_ = std::isfinite(energy(model_, x_, p_));
  if (good_) residuals_ = comparison_(x_, head_pose(unknowns_, unknowns(v)));
  return good_;
}

void FullSpace::make_pattern() {
  std::vector<Eigen::Triplet<double>> entries;
  each_lower([&](int row, int column, double) { entries.emplace_back(row, column, 0.0); });
  for (Eigen::Index c = 0; c < free_ + count_; ++c)
    for (Eigen::Index r = std::max(c, free_); r < free_ + count_; ++r)
      entries.emplace_back(int(r), int(c), 0.0);
  // All points of a curve hang on the whole line; others on nodes that share an element.
  std::vector<int> together;
  const auto add_node = [&](int node) {
    for (int i = 0; i < 3; ++i)
      if (const int u = model_.dofs.unknown(3 * node + i); u >= 0) together.push_back(u);
  };
  if (!comparison_.target().curve.empty())
    for (int node : comparison_.line().nodes()) add_node(node);
  for (int a : together)
    for (int b : together)
      if (a >= b) entries.emplace_back(a, b, 0.0);
  hessian_.resize(free_ + count_, free_ + count_);
  hessian_.setFromTriplets(entries.begin(), entries.end());
  hessian_.makeCompressed();
}

void FullSpace::add_nodal(int i, int j, double value) {
  const int nodal = int(x_.size());
  const int a = i < nodal ? model_.dofs.unknown(i) : -1,
            b = j < nodal ? model_.dofs.unknown(j) : -1;
  if (i < nodal && j < nodal) {
    if (a >= 0 && b >= 0) add(a, b, length * length * value);
  } else if (i >= nodal && j >= nodal) {
    for (Eigen::Index c = 0; c < count_; ++c)
      for (Eigen::Index d = 0; d < count_; ++d)
        if (const double w = by_pose_(i - nodal, c) * by_pose_(j - nodal, d); w != 0)
          add(int(free_ + c), int(free_ + d), w * value);
  } else if (i >= nodal && b >= 0) {
    for (Eigen::Index c = 0; c < count_; ++c)
      if (const double w = by_pose_(i - nodal, c); w != 0)
        add(int(free_ + c), b, length * w * value);
  }
}

bool FullSpace::hessian(const Vector& v, double factor, const Vector& multipliers,
                        std::span<double> values) {
  if (!evaluate(v)) return false;
  std::fill_n(hessian_.valuePtr(), hessian_.nonZeros(), 0.0);
  // The misfit: squares of the slopes, and what they leave out.
  const int nodal = int(x_.size());
  for (size_t k = 0; k < residuals_.gradient.size(); ++k) {
    std::vector<std::pair<int, double>> slope;
    for (const auto& [node, g] : residuals_.gradient[k])
      for (int i = 0; i < 3; ++i)
        if (g[i] != 0) slope.emplace_back(3 * node + i, g[i]);
    for (int i = 0; i < 3; ++i) slope.emplace_back(nodal + i, residuals_.pose(Eigen::Index(k), i));
    for (const auto& [i, gi] : slope)
      for (const auto& [j, gj] : slope) add_nodal(i, j, factor * gi * gj);
  }
  for (const auto& e :
       misfit_curvature(comparison_, x_, head_pose(unknowns_, unknowns(v)), residuals_))
    add_nodal(e.row(), e.col(), factor * e.value());
  const Matrix of_prior = factor * prior_.hessian();
  // Equilibrium: mu . F has the second derivatives -(dK along mu) and (dP along mu), as third
  // derivatives of the energy are symmetric.
  const Vector along = model_.dofs.expand(multipliers) / force_unit;
  Matrix pulled = Matrix::Zero(nodal, count_);
  if (const double size = along.cwiseAbs().maxCoeff(); size > 0) {
    const double h = longest / size;
    const Positions up = x_ + h * along, down = x_ - h * along;
    stiffness(model_, up, p_, k_), stiffness(model_, down, p_, other_);
    k_.add(other_, -1);
    reduced_.assign(k_);
    each_lower(
        [&](int row, int column, double d) { add(row, column, -length * length * d / (2 * h)); });
    pulled = (force_by_unknown(model_, unknowns_, up, p_) -
              force_by_unknown(model_, unknowns_, down, p_)) /
             (2 * h);
  }
  const Matrix changes = pull_changes(model_, unknowns_, unknowns(v), x_, p_, along);
  for (Eigen::Index c = 0; c < count_; ++c) {
    const Vector row = length * model_.dofs.reduce(pulled.col(c));
    for (Eigen::Index r = 0; r < free_; ++r) add(int(free_ + c), int(r), row[r]);
    for (Eigen::Index d = 0; d <= c; ++d)
      add(int(free_ + c), int(free_ + d), of_prior(c, d) + 0.5 * (changes(c, d) + changes(d, c)));
  }
  for (size_t k = 0; k < values.size(); ++k) values[k] = hessian_.valuePtr()[k];
  return true;
}

}  // namespace

Answer infer_full_space(const Model& model, const Target& target, const Prior& prior, Workspace& ws,
                        const InferOptions& options) {
  if (target.empty()) throw InputError("the target has no points");
  const Comparison comparison(model, target);
  auto unknowns = unknowns_of(model, prior, options.bilateral.value_or(target.midsagittal()));
  PriorTerms terms = prior_terms(prior, unknowns);
  InferOptions way = options;
  way.tolerance = near_enough;
  const Answer near = infer(model, target, prior, ws, way);
  if (near.status != InferStatus::converged) return near;
  FullSpace program(model, comparison, unknowns, terms, options);
  const Vector& z = near.activations;
  ProgramOptions how;
  how.max_iterations = most_iterations;
  how.tolerance = 1e-6, how.barrier = 1e-2, how.push = 1e-3;
  const ProgramResult r =
      solve(program, program.start(near.shape, z.cwiseMax(terms.lower).cwiseMin(terms.upper)), how);
  Answer answer;
  answer.iterations = near.iterations + r.iterations;
  const InferStatus stop = program.clock().reason();
  if (stop != InferStatus::converged || !r.solved) {
    answer.status = stop != InferStatus::converged ? stop : InferStatus::failed;
    answer.message = fmt::format("full space: Ipopt stopped (status {})", r.status);
    answer.wall_s = near.wall_s + program.clock().seconds();
    return answer;
  }
  // The reduced objective at the same point, for its posterior.
  InferOptions there = options;
  there.start = program.unknowns(r.v), there.start_shape = program.shape(r.v);
  there.start_by_unknown = {}, there.deadline_s = 0;
  Objective objective(model, comparison, prior, there, ws);
  if (const auto* point = objective.derivatives(there.start)) {
    answer.status = InferStatus::converged;
    set_optimum(*point, answer);
    summarise_posterior(objective, *point, comparison, options.model_error, answer);
  } else {
    answer.message = objective.last_failure();
  }
  answer.factorizations = near.factorizations + r.iterations + objective.factorizations();
  answer.forward_solves = near.forward_solves + objective.forward_solves();
  answer.wall_s = near.wall_s + program.clock().seconds();
  return answer;
}

}  // namespace genio
