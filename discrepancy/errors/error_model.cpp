#include "discrepancy/errors/error_model.hpp"

#include <Eigen/LU>
#include <cmath>
#include <map>
#include <numbers>

#include "forward/geometry/hex8.hpp"
#include "forward/model/at_anatomy.hpp"
#include "forward/model/half_model.hpp"
#include "inverse/target/comparison.hpp"

namespace genio {
namespace {

constexpr double root_accuracy = 1e-2;  // of a variance: nobody knows it better

/// Contour that each residual's point was traced with: -1 a point by itself.
std::vector<int> contours(const Target& t) {
  std::vector<int> of_point(t.curve.size(), 0);
  of_point.resize(t.curve.size() + t.flesh.size(), -1);
  for (const auto& p : t.surface) of_point.push_back(1 + p.slice);
  return of_point;
}

/// d N_b / dX at each node, the mean over its elements: pairs (b, gradient).
std::vector<std::vector<std::pair<int, Vec3>>> nodal_gradients(const HexMesh& mesh) {
  std::vector<std::vector<std::pair<int, Vec3>>> result(mesh.nodes.size());
  std::vector<int> count(mesh.nodes.size(), 0);
  for (const auto& e : mesh.elements)
    for (int a : e) ++count[size_t(a)];
  for (const auto& e : mesh.elements)
    for (size_t a = 0; a < 8; ++a) {
      // At the corner's Gauss point: at a corner itself an element may be folded.
      const auto local = hex8::derivatives(hex8::gauss_points()[a]);
      const auto corner = [&](int b) -> const Vec3& { return mesh.nodes[size_t(e[size_t(b)])]; };
      const Mat3 inverse = hex8::jacobian(corner, local).inverse();
      for (size_t b = 0; b < 8; ++b)
        result[size_t(e[a])].emplace_back(e[b], inverse.transpose() *
                                                    local.row(Eigen::Index(b)).transpose() /
                                                    double(count[size_t(e[a])]));
    }
  return result;
}

}  // namespace

Matrix noise_covariance(const Target& target, const Residuals& r, double length) {
  const auto contour = contours(target);
  const auto n = Eigen::Index(r.rows.size());
  Matrix c = Matrix::Identity(n, n);
  if (length <= 0) return c;
  std::vector<Vec3> across;  // direction of each residual
  for (const auto& gradient : r.gradient) {
    Vec3 sum = Vec3::Zero();
    for (const auto& [node, g] : gradient) sum += g;
    across.push_back(sum.normalized());
  }
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j < i; ++j) {
      const int a = r.rows[size_t(i)].point, b = r.rows[size_t(j)].point;
      if (contour[size_t(a)] < 0 || contour[size_t(a)] != contour[size_t(b)]) continue;
      const double apart = (r.places[size_t(a)] - r.places[size_t(b)]).norm();
      c(i, j) = c(j, i) = std::exp(-apart / length) * across[size_t(i)].dot(across[size_t(j)]);
    }
  return c;
}

Matrix fibre_influence(const Model& model, const FittedCondition& c, const Matrix& influence) {
  const Forces f = forces_of(model, c.x, c.parameters, [](const Effect& e) { return e.commands; });
  Stiffness k(model.pattern);
  const auto here = at_anatomy(model, c.parameters);
  for (const auto& e : here->potentials)
    if (model.effects[size_t(e.effect)].commands) e->add_stiffness(c.x, e.values(c.parameters), k);
  const Matrix turned = k.multiply_columns(influence.transpose());  // 3 n x rows
  const auto gradients = nodal_gradients(here->mesh);
  Matrix result = Matrix::Zero(influence.rows(), influence.cols());
  for (size_t a = 0; a < gradients.size(); ++a) {
    const auto at = 3 * Eigen::Index(a);
    const Vec3 pull = f.segment<3>(at);
    Mat3 stretch = Mat3::Zero();
    for (const auto& [b, g] : gradients[a]) stretch += node_position(c.x, b) * g.transpose();
    auto block = result.middleCols<3>(at);
    block -= turned.middleRows<3>(at).transpose() * stretch;
    if (pull.isZero(0)) continue;
    for (const auto& [b, g] : gradients[a])
      block += influence.middleCols<3>(3 * b) * pull * g.transpose();
  }
  return result;
}

Covariance fibre_covariance(const Model& model, const ErrorModel& error_model, int axis) {
  // A mean angle of two Gaussian parts of sd s is s sqrt(pi / 2); the slope of a Gaussian field of
  // sd a and length l is a / l.
  const double slope =
      error_model.fibre_turn * std::numbers::pi / 180 / std::sqrt(std::numbers::pi / 2);
  const double variance = std::pow(slope * error_model.fibre_length, 2);
  const double scale = 0.5 / (error_model.fibre_length * error_model.fibre_length);
  const double alike_part = error_model.fibres_alike;
  const auto right_of = [](const Vec3& x) { return Vec3(x[0], std::abs(x[1]), x[2]); };
  const auto side = [](const Vec3& x) {
    return std::abs(x[1]) < on_plane ? 0.0 : std::copysign(1.0, x[1]);
  };
  return [=, &nodes = model.mesh.nodes](Eigen::Index a, Eigen::Index b) {
    const Vec3 &x = nodes[size_t(a)], &y = nodes[size_t(b)];
    const double own = std::exp(-scale * (x - y).squaredNorm());
    const double alike = (axis == 1 ? side(x) * side(y) : 1) *
                         std::exp(-scale * (right_of(x) - right_of(y)).squaredNorm());
    return variance * (alike_part * alike + (1 - alike_part) * own);
  };
}

Matrix efficacy_covariance(const ConditionSet& set, const JointFit& fit,
                           const std::vector<Matrix>& influences, const ErrorModel& error_model) {
  Eigen::Index rows = 0, first = 0;
  for (const Matrix& a : influences) rows += a.rows();
  std::map<std::string, Vector> each, both;  // residuals of all conditions by a muscle's scale
  const auto add = [&](auto& sums, const std::string& name, Eigen::Index at, const Vector& r) {
    sums.try_emplace(name, Vector::Zero(rows)).first->second.segment(at, r.size()) += r;
  };
  for (size_t k = 0; k < influences.size(); first += influences[k++].rows()) {
    const FittedCondition& c = fit.conditions[k];
    const Model& model = set.model(k);
    std::vector<int> pulling;
    for (size_t p = 0; p < model.parameters.size(); ++p)
      if (model.parameters[p].is_command && c.parameters[Eigen::Index(p)] > 0)
        pulling.push_back(int(p));
    const Matrix by_force = influences[k] * force_derivatives(model, c.x, c.parameters, pulling);
    for (size_t i = 0; i < pulling.size(); ++i)
      add(each, model.parameters[size_t(pulling[i])].name.key, first,
          c.parameters[pulling[i]] * by_force.col(Eigen::Index(i)));
  }
  for (const auto& [name, r] : each) add(both, bilateral_name(name), 0, r);
  Matrix covariance = Matrix::Zero(rows, rows);
  const double variance = error_model.efficacy_sd * error_model.efficacy_sd;
  for (const auto& [name, r] : both)
    covariance += error_model.fibres_alike * variance * r * r.transpose();
  for (const auto& [name, r] : each)
    covariance += (1 - error_model.fibres_alike) * variance * r * r.transpose();
  return covariance;
}

Matrix residual_covariance(ConditionSet& set, const JointFit& fit,
                           const std::vector<Matrix>& influences, const Corrections& corrections,
                           const ErrorModel& error_model) {
  Eigen::Index rows = 0;
  std::vector<Eigen::Index> first;
  for (const Matrix& a : influences) first.push_back(rows), rows += a.rows();
  Matrix covariance = Matrix::Zero(rows, rows);
  Vector tissue(rows), mesh = Vector::Zero(rows);
  Matrix turned(rows, influences.front().cols());
  for (size_t k = 0; k < influences.size(); ++k) {
    const FittedCondition& c = fit.conditions[k];
    const Model& model = set.model(k);
    const auto count = influences[k].rows();
    auto block = covariance.block(first[k], first[k], count, count);
    // By the normals of the finer tongue, which are nearer to the true ones.
    block += noise_covariance(set.condition(k).target,
                              corrections.empty() ? c.residuals : corrections[k].exact,
                              set.observations().noise_correlation);
    turned.middleRows(first[k], count) = fibre_influence(model, c, influences[k]);
    Vector by_scale = Vector::Zero(c.x.size());
    for (const char* name : {"elasticity.a10", "elasticity.a20"}) {
      const int p[] = {parameter_index(model, name)};
      by_scale += c.parameters[p[0]] * force_derivatives(model, c.x, c.parameters, p).col(0);
    }
    tissue.segment(first[k], count) = influences[k] * by_scale;
    double size = 0;
    if (!corrections.empty()) {
      const Vector& added = corrections[k].added;
      mesh.segment(first[k], count) = added;
      for (Eigen::Index i = 0; i < count; ++i)
        size += std::pow(added[i] / c.residuals.rows[size_t(i)].scale, 2) / double(count);
    }
    block += model_error_covariance(
        c.residuals,
        std::max(error_model.least_mesh_error, error_model.correction_sd * std::sqrt(size)),
        error_model.mesh_length);
    for (Eigen::Index i = 0; i < count; ++i)
      block(i, i) += std::pow(error_model.local_error * c.residuals.rows[size_t(i)].scale, 2);
  }
  const auto root = [&](int axis) {
    return covariance_root(turned.cols() / 3, fibre_covariance(set.model(0), error_model, axis),
                           root_accuracy);
  };
  const Matrix in_plane = root(0), across = root(1);
  for (int axis = 0; axis < 3; ++axis) {
    const Matrix along = turned(Eigen::all, Eigen::seqN(axis, turned.cols() / 3, 3));
    const Matrix part = along * (axis == 1 ? across : in_plane);
    covariance += part * part.transpose();
  }
  covariance += efficacy_covariance(set, fit, influences, error_model);
  covariance += std::pow(error_model.tissue_sd, 2) * tissue * tissue.transpose();
  covariance += std::pow(error_model.correction_sd, 2) * mesh * mesh.transpose();
  return covariance;
}

}  // namespace genio
