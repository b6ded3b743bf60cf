#include "inverse/shape/curvature.hpp"

#include <algorithm>

#include "forward/model/at_anatomy.hpp"
#include "forward/model/rest_derivatives.hpp"
#include "inverse/target/comparison.hpp"
#include "inverse/target/comparison_curvature.hpp"
#include "inverse/target/head_pose.hpp"

namespace genio {
namespace {

constexpr double step = 1e-7;  // longest displacement of a node [m]: contact hardens over 5e-5
constexpr double unknown_step = 1e-6;  // of an unknown: bones move by it while the shape stays
constexpr double nothing = 1e-12;      // relative, over such a step

/// The nodal fields that unknowns' modes of anatomy make, by what a mode moves: 3 n x count.
template <class OfMode>
Matrix by_unknown(const Model& model, const std::vector<Unknown>& unknowns, const Parameters& p,
                  OfMode of_mode) {
  Matrix motion = Matrix::Zero(model.rest.size(), Eigen::Index(unknowns.size()));
  for (size_t c = 0; c < unknowns.size(); ++c)
    for (size_t i = 0; i < unknowns[c].parameters.size(); ++i) {
      const int parameter = unknowns[c].parameters[i];
      if (const int mode = mode_of(model, parameter); mode >= 0)
        motion.col(Eigen::Index(c)) +=
            unknowns[c].shares[i] * unknowns[c].slope(p[parameter]) * of_mode(model, mode);
    }
  return motion;
}

Vector field_of_mode(const Model& model, int mode) {
  return nodal_field(model.description->modes[size_t(mode)]);
}

/// Unknowns that are no modes, and which of all they are; and which are modes.
struct PlainUnknowns {
  std::vector<Unknown> unknowns;
  std::vector<Eigen::Index> which;
};
std::pair<PlainUnknowns, std::vector<Eigen::Index>> without_modes(
    const Model& model, const std::vector<Unknown>& unknowns) {
  std::pair<PlainUnknowns, std::vector<Eigen::Index>> result;
  for (size_t c = 0; c < unknowns.size(); ++c) {
    const auto& parameters = unknowns[c].parameters;
    if (std::any_of(parameters.begin(), parameters.end(),
                    [&](int k) { return mode_of(model, k) >= 0; }))
      result.second.push_back(Eigen::Index(c));
    else
      result.first.unknowns.push_back(unknowns[c]), result.first.which.push_back(Eigen::Index(c));
  }
  return result;
}

/// K at x, times each column.
Matrix products(const Model& model, const Positions& x, const Parameters& p, const Matrix& columns,
                Stiffness& k) {
  stiffness(model, x, p, k);
  return k.multiply_columns(columns);
}

}  // namespace

Matrix force_by_unknown(const Model& model, const std::vector<Unknown>& unknowns,
                        const Positions& x, const Parameters& p) {
  Matrix pulls = Matrix::Zero(x.size(), Eigen::Index(unknowns.size()));
  for (size_t c = 0; c < unknowns.size(); ++c) {
    const Matrix each = force_derivatives(model, x, p, unknowns[c].parameters);
    for (size_t i = 0; i < unknowns[c].shares.size(); ++i)
      pulls.col(Eigen::Index(c)) += unknowns[c].shares[i] *
                                    unknowns[c].slope(p[unknowns[c].parameters[i]]) *
                                    each.col(Eigen::Index(i));
  }
  return pulls;
}

Matrix held_by_unknown(const Model& model, const std::vector<Unknown>& unknowns,
                       const Parameters& p) {
  return by_unknown(model, unknowns, p, held_by_mode);
}

Matrix pull_changes(const Model& model, const std::vector<Unknown>& unknowns, const Vector& z,
                    const Positions& x, const Parameters& p, const Vector& adjoint) {
  const Matrix fields = by_unknown(model, unknowns, p, field_of_mode);
  const auto parts = without_modes(model, unknowns);
  const PlainUnknowns& plain = parts.first;
  const auto pulls = [&](const Vector& at) -> Vector {
    Vector result = Vector::Zero(at.size());
    result(plain.which) = force_by_unknown(model, plain.unknowns, x + fields * (at - z),
                                           apply_unknowns(unknowns, at, p))
                              .transpose() *
                          adjoint;
    return result;
  };
  const Eigen::Index n = z.size();
  Matrix changes = Matrix::Zero(n, n);
  Vector uneven(n);
  for (Eigen::Index i = 0; i < n; ++i) uneven[i] = 1 + 0.37 * double(i % 5);
  const Vector here = pulls(z);
  if ((pulls(z + unknown_step * uneven) - here).norm() <= nothing * here.norm()) return changes;
  for (Eigen::Index i = 0; i < n; ++i) {
    const Vector e = unknown_step * Vector::Unit(n, i);
    changes.row(i) = (pulls(z + e) - pulls(z - e)).transpose() / (2 * unknown_step);
  }
  for (const Eigen::Index k : parts.second) changes.col(k) = changes.row(k).transpose();
  if (parts.second.empty()) return changes;
  std::vector<int> modes;
  Vector slopes(Eigen::Index(parts.second.size()));
  for (const Eigen::Index k : parts.second) {
    const Unknown& u = unknowns[size_t(k)];
    slopes[Eigen::Index(modes.size())] = u.shares.front() * u.slope(p[u.parameters.front()]);
    modes.push_back(mode_of(model, u.parameters.front()));
  }
  changes(parts.second, parts.second) =
      slopes.asDiagonal() * force_by_mode_pairs(model, x, p, modes, adjoint) * slopes.asDiagonal();
  return changes;
}

Vector misfit_gradient(const Residuals& residuals, Eigen::Index size) {
  Vector g = Vector::Zero(size);
  for (size_t k = 0; k < residuals.gradient.size(); ++k)
    for (const auto& [node, slope] : residuals.gradient[k])
      g.segment<3>(3 * node) += residuals.values[Eigen::Index(k)] * slope;
  return g;
}

Matrix target_curvature(const Comparison& comparison, const Positions& x, const HeadPose& pose,
                        const Residuals& residuals, const Matrix& positions,
                        const Matrix& pose_by_unknown) {
  Matrix all(positions.rows() + 3, positions.cols());
  all << positions, pose_by_unknown;
  Matrix product = Matrix::Zero(all.rows(), all.cols());
  for (const auto& e : misfit_curvature(comparison, x, pose, residuals))
    product.row(e.row()) += e.value() * all.row(e.col());
  const Matrix c = all.transpose() * product;
  return 0.5 * (c + c.transpose());
}

Matrix mechanical_curvature(const Model& model, const std::vector<Unknown>& unknowns,
                            const Vector& z, const Positions& x, const Parameters& p,
                            const Matrix& positions, const Vector& adjoint, Workspace& ws) {
  const double size = adjoint.cwiseAbs().maxCoeff();
  const Eigen::Index n = z.size();
  if (size == 0) return Matrix::Zero(n, n);
  const double h = step / size;
  // Along with a mode's field, so that little is strained.
  const Matrix fields = by_unknown(model, unknowns, p, field_of_mode);
  Matrix moving(positions.rows(), 2 * n);
  moving << positions - fields, fields - held_by_unknown(model, unknowns, p);
  const auto own = moving.leftCols(n);
  const Positions up = x + h * adjoint, down = x - h * adjoint;
  const Matrix bent = (products(model, up, p, moving, ws.stiffness) -
                       products(model, down, p, moving, ws.stiffness)) /
                      (2 * h);
  const Matrix pulled =
      (force_by_unknown(model, unknowns, up, p) - force_by_unknown(model, unknowns, down, p)) /
          (2 * h) -
      bent.rightCols(n);
  const Matrix crossed = own.transpose() * pulled;
  const Matrix s = crossed + crossed.transpose() - own.transpose() * bent.leftCols(n) +
                   pull_changes(model, unknowns, z, x, p, adjoint);
  return 0.5 * (s + s.transpose());
}

}  // namespace genio
