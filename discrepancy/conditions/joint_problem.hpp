#pragma once
// The joint misfit as descend() wants it. Not for other rooms.

#include "discrepancy/conditions/joint_fit.hpp"
#include "inverse/shape/objective.hpp"
#include "inverse/target/comparison.hpp"

namespace genio {

/// One after another.
Vector stacked(const std::vector<Vector>& parts);

/// Commands of every condition, then what they share.
class JointProblem final : public MisfitProblem {
 public:
  struct Part {
    Part(ConditionSet& set, size_t k, const Prior& prior, InferOptions how, Vector off)
        : comparison(set.model(k), set.condition(k).target, surface_smoothing),
          correction(std::move(off)),
          options(std::move(how)),
          objective(set.model(k), comparison, prior, options, set.workspace(k)) {}
    /// Residuals of a point with the mesh's own error taken off.
    Vector residuals(const ObjectivePoint& point) const {
      return correction.size() == 0 ? point.residuals.values : point.residuals.values + correction;
    }
    Comparison comparison;
    Vector correction;  // empty: none
    InferOptions options;
    Objective objective;
    std::vector<int> which;
  };

  JointProblem(ConditionSet& set, const SharedPrior& shared, const Errors* errors,
               const FitOptions& options);

  const Vector& lower() const override { return lower_; }
  const Vector& upper() const override { return upper_; }
  std::optional<double> value(const Vector& u) override;
  std::shared_ptr<LocalModel> local(const Vector& u) override;
  bool stopped() override { return false; }
  const std::string& last_failure() const override { return failure_; }
  double rms() const override { return rms_; }

  int own() const { return own_; }
  Part& part(size_t k) { return *parts_[k]; }
  size_t size() const { return parts_.size(); }
  Vector of_part(const Vector& u, size_t k) const { return u(parts_[k]->which); }
  double prior_value(const Vector& u) const { return 0.5 * (rows_ * u - values_).squaredNorm(); }
  const Matrix& prior_rows() const { return rows_; }
  const Vector& prior_values() const { return values_; }
  /// L^-1 m with L the covariance's factor.
  Matrix whitened(const Matrix& m) const;

 private:
  void number_unknowns();
  void fix(const std::map<ParameterName, double>& values);

  const Errors* errors_;
  std::vector<std::unique_ptr<Part>> parts_;
  int own_ = 0;
  Vector lower_, upper_, values_;
  Matrix rows_;
  std::string failure_;
  double rms_ = 0;
};

}  // namespace genio
