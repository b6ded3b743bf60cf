#include "discrepancy/conditions/joint_problem.hpp"

#include <cmath>

#include "forward/model/at_anatomy.hpp"

namespace genio {
namespace {

/// 1/2 |r + J d|^2 + 1/2 |A (anchor + d) - b|^2, r and J already whitened.
class QuadraticModel final : public LocalModel {
 public:
  QuadraticModel(const Vector& r, const Matrix& jacobian, const Matrix& rows, const Vector& values,
                 Vector anchor, std::vector<Matrix> moves)
      : anchor_(std::move(anchor)), moves_(std::move(moves)) {
    const Vector prior = rows * anchor_ - values;
    value_ = 0.5 * (r.squaredNorm() + prior.squaredNorm());
    slope_ = jacobian.transpose() * r + rows.transpose() * prior;
    hessian_ = jacobian.transpose() * jacobian + rows.transpose() * rows;
  }
  void set_bounds(Vector lower, Vector upper) override {
    lower_ = std::move(lower), upper_ = std::move(upper);
  }
  const Vector& anchor() const override { return anchor_; }
  double reach(const Vector& d) const override {
    double longest = 0;
    for (const Matrix& m : moves_)
      if (m.rows() > 0) longest = std::max(longest, (m * d).cwiseAbs().maxCoeff());
    return longest;
  }
  const Vector& lower() const override { return lower_; }
  const Vector& upper() const override { return upper_; }
  bool value(const Vector& u, double& f) override {
    const Vector d = u - anchor_;
    f = value_ + slope_.dot(d) + 0.5 * d.dot(hessian_ * d);
    return true;
  }
  bool gradient(const Vector& u, Vector& g) override {
    g = slope_ + hessian_ * (u - anchor_);
    return true;
  }
  Entries hessian_entries() const override {
    Entries entries;
    for (int c = 0; c < int(hessian_.cols()); ++c)
      for (int r = c; r < int(hessian_.rows()); ++r) entries.emplace_back(r, c);
    return entries;
  }
  bool hessian(const Vector&, double factor, const Vector&, std::span<double> values) override {
    size_t k = 0;
    for (Eigen::Index c = 0; c < hessian_.cols(); ++c)
      for (Eigen::Index r = c; r < hessian_.rows(); ++r) values[k++] = factor * hessian_(r, c);
    return true;
  }

 private:
  Vector anchor_, slope_, lower_, upper_;
  std::vector<Matrix> moves_;
  Matrix hessian_;
  double value_ = 0;
};

constexpr int start_factorizations = 60;  // near a known shape more lead nowhere

InferOptions starting(const ConditionSet& set, size_t k, const FitOptions& fit) {
  InferOptions options;
  options.bilateral = set.bilateral(k);
  if (fit.start) {
    // What is held here may have moved under the model that the start is from: an open jaw.
    const Model& m = set.model(k);
    options.start_shape = carried(m, (*fit.start)[k].x, default_parameters(m));
    options.start_factorizations = start_factorizations;
  }
  return options;
}

}  // namespace

JointProblem::JointProblem(ConditionSet& set, const SharedPrior& shared, const Errors* errors,
                           const FitOptions& options)
    : errors_(errors) {
  const bool corrected = errors && !errors->corrections.empty();
  for (size_t k = 0; k < set.size(); ++k) {
    Prior prior = set.prior(k);
    prior.parameters.clear();
    for (const auto& [name, belief] : shared.parameters) prior.parameters[name.text()] = belief;
    if (shared.head_pose) prior.head_pose = shared.head_pose;
    parts_.push_back(std::make_unique<Part>(set, k, prior, starting(set, k, options),
                                            corrected ? errors->corrections[k].added : Vector()));
    const bool pose_is_shared = shared.head_pose.has_value();
    for (const Unknown& c : parts_.back()->objective.unknowns())
      parts_.back()->which.push_back(c.kind == Unknown::Kind::parameter ||
                                             (c.kind == Unknown::Kind::pose && pose_is_shared)
                                         ? -1
                                         : own_++);
  }
  number_unknowns();
  fix(options.fixed);
}

/// Shared unknowns that stay; what is believed of them does not matter any more.
void JointProblem::fix(const std::map<ParameterName, double>& values) {
  const auto& unknowns = parts_.front()->objective.unknowns();
  for (size_t i = 0; i < unknowns.size(); ++i) {
    const auto at = values.find(unknowns[i].parameter);
    const Eigen::Index u = parts_.front()->which[i];
    if (at == values.end() || u < own_) continue;
    lower_[u] = upper_[u] = unknowns[i].z_of(at->second);
    for (Eigen::Index r = 0; r < rows_.rows(); ++r)
      if (rows_(r, u) != 0) rows_.row(r).setZero(), values_[r] = 0;
  }
}

void JointProblem::number_unknowns() {
  int count = own_;
  std::vector<std::pair<Matrix, Vector>> blocks;
  for (auto& part : parts_) {
    int next = own_;
    for (int& w : part->which)
      if (w < 0) w = next++;
    count = std::max(count, next);
  }
  lower_.resize(count), upper_.resize(count);
  Eigen::Index rows = 0;
  std::vector<std::pair<size_t, Eigen::Index>> kept;  // part and row; shared ones count once
  for (size_t k = 0; k < parts_.size(); ++k) {
    const PriorTerms& prior = parts_[k]->objective.prior();
    const auto& which = parts_[k]->which;
    lower_(which) = prior.lower, upper_(which) = prior.upper;
    for (Eigen::Index r = 0; r < prior.rows.rows(); ++r) {
      bool is_shared = false;
      for (size_t i = 0; i < which.size(); ++i)
        is_shared |= which[i] >= own_ && prior.rows(r, Eigen::Index(i)) != 0;
      if (!is_shared || k == 0) kept.emplace_back(k, r), ++rows;
    }
  }
  rows_ = Matrix::Zero(rows, count);
  values_.resize(rows);
  for (Eigen::Index i = 0; i < rows; ++i) {
    const auto [k, r] = kept[size_t(i)];
    const PriorTerms& prior = parts_[k]->objective.prior();
    for (size_t c = 0; c < parts_[k]->which.size(); ++c)
      rows_(i, parts_[k]->which[c]) = prior.rows(r, Eigen::Index(c));
    values_[i] = prior.values[r];
  }
}

Matrix JointProblem::whitened(const Matrix& m) const {
  return errors_ ? Matrix(errors_->covariance.matrixL().solve(m)) : m;
}

Vector stacked(const std::vector<Vector>& parts) {
  Eigen::Index rows = 0;
  for (const Vector& v : parts) rows += v.size();
  Vector all(rows);
  rows = 0;
  for (const Vector& v : parts) all.segment(rows, v.size()) = v, rows += v.size();
  return all;
}

std::optional<double> JointProblem::value(const Vector& u) {
  std::vector<Vector> r;
  double square = 0, points = 0;
  for (size_t k = 0; k < parts_.size(); ++k) {
    const auto* point = parts_[k]->objective.at(of_part(u, k));
    if (!point) {
      failure_ = parts_[k]->objective.last_failure();
      return {};
    }
    r.push_back(parts_[k]->residuals(*point));
    square += point->residuals.distances.squaredNorm();
    points += double(point->residuals.distances.size());
  }
  rms_ = std::sqrt(square / std::max(1.0, points));
  return 0.5 * whitened(stacked(r)).squaredNorm() + prior_value(u);
}

std::shared_ptr<LocalModel> JointProblem::local(const Vector& u) {
  std::vector<const ObjectivePoint*> points;
  Eigen::Index rows = 0;
  for (size_t k = 0; k < parts_.size(); ++k) {
    points.push_back(parts_[k]->objective.derivatives(of_part(u, k)));
    if (!points.back()) {
      failure_ = parts_[k]->objective.last_failure();
      return nullptr;
    }
    rows += points.back()->residuals.values.size();
  }
  Vector r(rows);
  Matrix jacobian = Matrix::Zero(rows, u.size());
  std::vector<Matrix> moves;
  rows = 0;
  for (size_t k = 0; k < parts_.size(); ++k) {
    const ObjectivePoint& p = *points[k];
    const auto count = p.residuals.values.size();
    r.segment(rows, count) = parts_[k]->residuals(p);
    jacobian.middleRows(rows, count)(Eigen::all, parts_[k]->which) = p.jacobian;
    rows += count;
    // Only the measured nodes tell how far a step goes.
    const auto& nodes = parts_[k]->comparison.nodes();
    Matrix move = Matrix::Zero(3 * Eigen::Index(nodes.size()), u.size());
    for (size_t a = 0; a < nodes.size(); ++a)
      move.middleRows<3>(3 * Eigen::Index(a))(Eigen::all, parts_[k]->which) =
          p.positions.middleRows<3>(3 * nodes[a]);
    moves.push_back(std::move(move));
  }
  return std::make_unique<QuadraticModel>(whitened(r).col(0), whitened(jacobian), rows_, values_, u,
                                          std::move(moves));
}

}  // namespace genio
