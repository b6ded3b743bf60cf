#pragma once
// The stiffness over the free unknowns as a sparse matrix, and its Cholesky factor (CHOLMOD).

#include <Eigen/SparseCore>
#include <memory>
#include <vector>

#include "forward/algebra/stiffness.hpp"
#include "forward/algebra/supports.hpp"

namespace genio {

/// Lower triangle of the stiffness over the unknowns, filled from node blocks by a fixed scatter.
class ReducedStiffness {
 public:
  ReducedStiffness(const BlockPattern& pattern, const DofMap& dofs);

  void assign(const Stiffness& k);
  Vector multiply(const Vector& v) const { return matrix_.selfadjointView<Eigen::Lower>() * v; }
  const Eigen::SparseMatrix<double>& lower() const { return matrix_; }
  /// Runs of unknowns that belong together, a node's or a body's: the first unknown of each, and
  /// the number of unknowns last. They share their couplings, so an ordering may treat each as one.
  const std::vector<int>& groups() const { return groups_; }
  double trace() const { return matrix_.diagonal().sum(); }

 private:
  Eigen::SparseMatrix<double> matrix_;
  // Entry i of the block values goes to matrix value target_[i]; -1: nowhere, and targets of
  // off-diagonal blocks that meet on the diagonal of a rigid body count twice.
  std::vector<int> target_;
  std::vector<bool> twice_;
  std::vector<int> groups_;
};

/// K = L L^T, supernodal. Ordered and analysed once; factorised as often as needed.
class Cholesky {
 public:
  explicit Cholesky(const ReducedStiffness& k) : Cholesky(k.lower(), k.groups()) {}
  /// `lower`: its pattern; `groups` as in ReducedStiffness.
  Cholesky(const Eigen::SparseMatrix<double>& lower, const std::vector<int>& groups);
  ~Cholesky();
  Cholesky(const Cholesky&) = delete;
  Cholesky& operator=(const Cholesky&) = delete;

  /// Factorises K + shift I. False where that is not positive definite; the factor is then void.
  bool factorize(const ReducedStiffness& k, double shift = 0) {
    return factorize(k.lower(), shift);
  }
  bool factorize(const Eigen::SparseMatrix<double>& lower, double shift = 0);
  bool valid() const { return valid_; }
  Vector solve(const Vector& right_hand_side) const;
  /// solve() in single precision, in less than half the time: to precondition, not to answer.
  Vector precondition(const Vector& right_hand_side) const;
  Matrix solve(const Matrix& right_hand_sides) const;
  int factorizations() const { return factorizations_; }
  /// Floating-point operations of one factorisation, as analysed.
  double flops() const;
  /// About how many preconditioned iterations cost as much as one factorisation.
  int iterations_per_factor() const;

 private:
  struct Impl;
  void solve(const double* right, double* solution, Eigen::Index columns) const;

  std::unique_ptr<Impl> impl_;
  bool valid_ = false;
  int factorizations_ = 0;
};

}  // namespace genio
