#pragma once
// The misfit with the mechanics replaced by their derivative at a known shape: what Ipopt minimises
// between two equilibria.

#include <Eigen/SparseCore>

#include "inverse/solver/local_model.hpp"
#include "inverse/target/comparison.hpp"
#include "inverse/target/head_pose.hpp"
#include "inverse/target/target.hpp"

namespace genio {

/// A shape that a target is compared with, to first order about a known one in some unknowns.
struct LocalShape {
  /// `positions`: dx/du (3 n x count), of which only the rows of the target's nodes are kept.
  LocalShape(const Comparison& comparison, const Positions& x, const Matrix& positions,
             const HeadPose& pose, const Matrix& pose_by_unknown, std::vector<int> which);

  const Comparison* comparison;
  std::vector<int> which;  ///< the unknowns it follows
  Positions x;
  HeadPose pose;
  std::vector<int> nodes;  ///< of the target
  std::vector<int> row;    ///< of each node in by_unknown, over 3; -1: not the target's
  Matrix by_unknown;       ///< d positions of `nodes` / du
  Matrix pose_by_unknown;  ///< 3 x count
  Matrix curvature;        ///< second derivative of the misfit that the mechanics add; may be empty
  Matrix target_curvature;  ///< that of the target itself at the anchor, for the Hessian
};

/// 1/2 |A u - b|^2.
struct QuadraticTerm {
  Eigen::SparseMatrix<double> rows;  ///< A
  Vector values;                     ///< b

  double value(const Vector& u) const { return 0.5 * (rows * u - values).squaredNorm(); }
  Vector gradient(const Vector& u) const { return rows.transpose() * (rows * u - values); }
};

/// sum over shapes of 1/2 |residuals(x + X d, pose + P d)|^2 + 1/2 d.C d, plus the prior, d = u
/// less the anchor. Value and gradient are exact at the anchor; residuals are those of the target
/// itself.
class LocalProblem final : public LocalModel {
 public:
  LocalProblem(std::vector<LocalShape> shapes, QuadraticTerm prior, Vector anchor);

  void set_bounds(Vector lower, Vector upper) override;
  const Vector& anchor() const override { return anchor_; }
  double reach(const Vector& d) const override;

  const Vector& lower() const override { return lower_; }
  const Vector& upper() const override { return upper_; }
  bool value(const Vector& u, double& f) override;
  bool gradient(const Vector& u, Vector& g) override;
  Entries hessian_entries() const override;
  bool hessian(const Vector& u, double factor, const Vector&, std::span<double> values) override;

  const std::vector<LocalShape>& shapes() const { return shapes_; }
  /// d residuals / d unknowns of all shapes, over all unknowns, one shape's rows after another's.
  Matrix jacobian(const Vector& u);
  /// The Hessian that Ipopt gets, at u.
  const Eigen::SparseMatrix<double>& hessian(const Vector& u);

 private:
  void evaluate(const Vector& u);

  std::vector<LocalShape> shapes_;
  QuadraticTerm prior_;
  Vector anchor_, lower_, upper_;
  Eigen::SparseMatrix<double> of_prior_, hessian_;  // lower triangles
  Vector at_;                                       // latest point, and there:
  double value_ = 0;
  Vector gradient_;
  std::vector<Matrix> jacobians_;
};

}  // namespace genio
