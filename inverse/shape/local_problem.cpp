#include "inverse/shape/local_problem.hpp"

#include <algorithm>

#include "inverse/target/comparison.hpp"
#include "inverse/target/head_pose.hpp"

namespace genio {
namespace {

/// d residuals / d unknowns of one shape.
Matrix by_unknowns(const LocalShape& s, const Residuals& r) {
  Matrix j = r.pose * s.pose_by_unknown;
  for (size_t k = 0; k < r.gradient.size(); ++k)
    for (const auto& [node, g] : r.gradient[k])
      j.row(Eigen::Index(k)) += g.transpose() * s.by_unknown.middleRows<3>(3 * s.row[size_t(node)]);
  return j;
}

Residuals residuals(const LocalShape& s, const Vector& d) {
  Positions x = s.x;
  const Vector moved = s.by_unknown * d;
  for (size_t k = 0; k < s.nodes.size(); ++k)
    x.segment<3>(3 * s.nodes[k]) += moved.segment<3>(3 * Eigen::Index(k));
  const Vec3 pose = s.pose_by_unknown * d;
  return (*s.comparison)(x, {s.pose.shift + pose.head<2>(), s.pose.turn + pose[2]});
}

/// Entries of `m` over the unknowns `which`, lower triangle.
template <class Act>
void each_entry(const std::vector<int>& which, Act act) {
  for (size_t i = 0; i < which.size(); ++i)
    for (size_t j = 0; j < which.size(); ++j)
      if (which[i] >= which[j]) act(which[i], which[j], Eigen::Index(i), Eigen::Index(j));
}

Matrix bend(const LocalShape& s) {
  const auto n = Eigen::Index(s.which.size());
  Matrix m = Matrix::Zero(n, n);
  if (s.curvature.size() > 0) m += s.curvature;
  if (s.target_curvature.size() > 0) m += s.target_curvature;
  return m;
}

}  // namespace

LocalShape::LocalShape(const Comparison& c, const Positions& at, const Matrix& positions,
                       const HeadPose& head, const Matrix& head_by_unknown,
                       std::vector<int> unknowns)
    : comparison(&c),
      which(std::move(unknowns)),
      x(at),
      pose(head),
      nodes(c.nodes()),
      row(size_t(at.size() / 3), -1),
      by_unknown(3 * Eigen::Index(nodes.size()), positions.cols()),
      pose_by_unknown(head_by_unknown) {
  for (size_t k = 0; k < nodes.size(); ++k) {
    row[size_t(nodes[k])] = int(k);
    by_unknown.middleRows<3>(3 * Eigen::Index(k)) = positions.middleRows<3>(3 * nodes[k]);
  }
}

LocalProblem::LocalProblem(std::vector<LocalShape> shapes, QuadraticTerm prior, Vector anchor)
    : shapes_(std::move(shapes)), prior_(std::move(prior)), anchor_(std::move(anchor)) {
  const auto n = anchor_.size();
  of_prior_ = Eigen::SparseMatrix<double>(prior_.rows.transpose() * prior_.rows)
                  .triangularView<Eigen::Lower>();
  std::vector<Eigen::Triplet<double>> entries;
  for (Eigen::Index i = 0; i < n; ++i) entries.emplace_back(int(i), int(i), 0.0);
  for (Eigen::Index k = 0; k < of_prior_.outerSize(); ++k)
    for (Eigen::SparseMatrix<double>::InnerIterator it(of_prior_, k); it; ++it)
      entries.emplace_back(int(it.row()), int(it.col()), 0.0);
  for (const LocalShape& s : shapes_)
    each_entry(s.which, [&](int row, int column, Eigen::Index, Eigen::Index) {
      entries.emplace_back(row, column, 0.0);
    });
  hessian_.resize(n, n);
  hessian_.setFromTriplets(entries.begin(), entries.end());
  hessian_.makeCompressed();
}

void LocalProblem::set_bounds(Vector lower, Vector upper) {
  lower_ = std::move(lower), upper_ = std::move(upper);
}

double LocalProblem::reach(const Vector& d) const {
  double longest = 0;
  for (const LocalShape& s : shapes_)
    longest = std::max(longest, (s.by_unknown * d(s.which)).cwiseAbs().maxCoeff());
  return longest;
}

void LocalProblem::evaluate(const Vector& u) {
  if (at_.size() == u.size() && at_ == u) return;
  at_ = u;
  value_ = prior_.value(u);
  gradient_ = prior_.gradient(u);
  jacobians_.clear();
  for (const LocalShape& s : shapes_) {
    const Vector d = (u - anchor_)(s.which);
    const Residuals r = residuals(s, d);
    jacobians_.push_back(by_unknowns(s, r));
    value_ += 0.5 * r.values.squaredNorm();
    Vector g = jacobians_.back().transpose() * r.values;
    if (s.curvature.size() > 0) {
      const Vector c = s.curvature * d;
      value_ += 0.5 * d.dot(c), g += c;
    }
    for (size_t i = 0; i < s.which.size(); ++i) gradient_[s.which[i]] += g[Eigen::Index(i)];
  }
}

Matrix LocalProblem::jacobian(const Vector& u) {
  evaluate(u);
  Eigen::Index rows = 0;
  for (const Matrix& j : jacobians_) rows += j.rows();
  Matrix all = Matrix::Zero(rows, u.size());
  rows = 0;
  for (size_t k = 0; k < jacobians_.size(); ++k) {
    all.middleRows(rows, jacobians_[k].rows())(Eigen::all, shapes_[k].which) = jacobians_[k];
    rows += jacobians_[k].rows();
  }
  return all;
}

bool LocalProblem::value(const Vector& u, double& f) {
  evaluate(u);
  f = value_;
  return std::isfinite(f);
}

bool LocalProblem::gradient(const Vector& u, Vector& g) {
  evaluate(u);
  g = gradient_;
  return g.allFinite();
}

NonlinearProgram::Entries LocalProblem::hessian_entries() const {
  Entries entries;
  for (Eigen::Index k = 0; k < hessian_.outerSize(); ++k)
    for (Eigen::SparseMatrix<double>::InnerIterator it(hessian_, k); it; ++it)
      entries.emplace_back(int(it.row()), int(it.col()));
  return entries;
}

const Eigen::SparseMatrix<double>& LocalProblem::hessian(const Vector& u) {
  evaluate(u);
  std::fill_n(hessian_.valuePtr(), hessian_.nonZeros(), 0.0);
  for (Eigen::Index k = 0; k < of_prior_.outerSize(); ++k)
    for (Eigen::SparseMatrix<double>::InnerIterator it(of_prior_, k); it; ++it)
      hessian_.coeffRef(it.row(), it.col()) += it.value();
  for (size_t k = 0; k < shapes_.size(); ++k) {
    const Matrix h = jacobians_[k].transpose() * jacobians_[k] + bend(shapes_[k]);
    each_entry(shapes_[k].which, [&](int row, int column, Eigen::Index i, Eigen::Index j) {
      hessian_.coeffRef(row, column) += h(i, j);
    });
  }
  return hessian_;
}

bool LocalProblem::hessian(const Vector& u, double factor, const Vector&,
                           std::span<double> values) {
  const auto& h = hessian(u);
  for (size_t k = 0; k < values.size(); ++k) values[k] = factor * h.valuePtr()[k];
  return true;
}

}  // namespace genio
