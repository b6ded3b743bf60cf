#include "inverse/shape/curvature.hpp"

#include "forward/model/at_anatomy.hpp"
#include "inverse/target/comparison.hpp"
#include "inverse/target/comparison_curvature.hpp"
#include "inverse/target/head_pose.hpp"

namespace genio {
namespace {

constexpr double step = 1e-7;  // longest displacement of a node [m]: contact hardens over 5e-5
constexpr double unknown_step = 1e-6;  // of an unknown: bones move by it while the shape stays
constexpr double nothing = 1e-12;      // relative, over such a step

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
  Matrix motion = Matrix::Zero(model.rest.size(), Eigen::Index(unknowns.size()));
  for (size_t c = 0; c < unknowns.size(); ++c)
    for (size_t i = 0; i < unknowns[c].parameters.size(); ++i) {
      const int k[] = {unknowns[c].parameters[i]};
      if (mode_of(model, k[0]) >= 0)
        motion.col(Eigen::Index(c)) +=
            unknowns[c].shares[i] * unknowns[c].slope(p[k[0]]) * held_motion(model, k);
    }
  return motion;
}

Matrix pull_changes(const Model& model, const std::vector<Unknown>& unknowns, const Vector& z,
                    const Positions& x, const Parameters& p, const Vector& adjoint) {
  const Matrix held = held_by_unknown(model, unknowns, p);
  const auto pulls = [&](const Vector& at) -> Vector {
    return force_by_unknown(model, unknowns, x + held * (at - z), apply_unknowns(unknowns, at, p))
               .transpose() *
           adjoint;
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
  const Matrix free = positions - held_by_unknown(model, unknowns, p);
  const Positions up = x + h * adjoint, down = x - h * adjoint;
  const Matrix bent =
      (products(model, up, p, free, ws.stiffness) - products(model, down, p, free, ws.stiffness)) /
      (2 * h);
  const Matrix pulled =
      (force_by_unknown(model, unknowns, up, p) - force_by_unknown(model, unknowns, down, p)) /
      (2 * h);
  const Matrix crossed = free.transpose() * pulled;
  const Matrix s = crossed + crossed.transpose() - free.transpose() * bent +
                   pull_changes(model, unknowns, z, x, p, adjoint);
  return 0.5 * (s + s.transpose());
}

}  // namespace genio
