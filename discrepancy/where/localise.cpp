#include "discrepancy/where/localise.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace genio {
namespace {

constexpr double half_width = 8e-3;  // |y| beyond which a place is called left or right [m]

std::string place_name(const TongueLine& line, const Positions& x, const Vec3& place) {
  std::string name = tongue_region(line, x, place);
  if (std::abs(place[1]) > half_width) name += place[1] > 0 ? ", right" : ", left";
  return name;
}

/// Covariance of the residuals after the fit, nothing missing: S - J (J' S^-1 J + P)^-1 J'.
Matrix after_fit(const JointFit& fit, const Matrix& covariance) {
  std::vector<Eigen::Index> open;
  for (Eigen::Index i = 0; i < fit.u.size(); ++i)
    if (fit.lower[i] < fit.upper[i]) open.push_back(i);
  if (open.empty()) return covariance;
  const Matrix j = fit.jacobian()(Eigen::all, open), a = fit.prior_rows(Eigen::all, open);
  const Matrix h = j.transpose() * covariance.llt().solve(j) + a.transpose() * a;
  return covariance - j * h.llt().solve(j.transpose());
}

/// Rows that average residuals of one condition about each of its rows.
Matrix averages(const JointFit& fit, double reach) {
  const auto n = fit.residuals().size();
  Matrix w = Matrix::Zero(n, n);
  Eigen::Index first = 0;
  for (const auto& c : fit.conditions) {
    const auto& r = c.residuals;
    const auto count = Eigen::Index(r.rows.size());
    for (Eigen::Index i = 0; i < count; ++i) {
      for (Eigen::Index k = 0; k < count; ++k) {
        const auto &a = r.rows[size_t(i)], &b = r.rows[size_t(k)];
        if (a.axis != b.axis) continue;
        const double apart = (r.places[size_t(a.point)] - r.places[size_t(b.point)]).squaredNorm();
        w(first + i, first + k) = std::exp(-0.5 * apart / (reach * reach));
      }
      w.row(first + i) /= w.row(first + i).sum();
    }
    first += count;
  }
  return w;
}

/// The largest p that is still a discovery (Benjamini & Hochberg 1995, eq. 1).
double threshold(std::vector<double> p, double rate) {
  std::sort(p.begin(), p.end());
  double t = 0;
  for (size_t i = 0; i < p.size(); ++i)
    if (p[i] <= rate * double(i + 1) / double(p.size())) t = p[i];
  return t;
}

std::vector<MapPatch> patches_of(const std::vector<MapPoint>& points) {
  std::vector<MapPatch> patches;
  for (const MapPoint& p : points) {
    if (!p.beyond) continue;
    auto at = std::find_if(patches.begin(), patches.end(), [&](const MapPatch& q) {
      return q.condition == p.condition && q.region == p.region && (q.mean > 0) == (p.distance > 0);
    });
    if (at == patches.end()) at = patches.insert(patches.end(), {p.condition, p.region, 0, 0});
    at->mean = (at->mean * at->points + p.distance) / (at->points + 1);
    ++at->points;
  }
  std::stable_sort(patches.begin(), patches.end(), [](const MapPatch& a, const MapPatch& b) {
    return std::abs(a.mean) * a.points > std::abs(b.mean) * b.points;
  });
  return patches;
}

}  // namespace

ResidualMap localise(const ConditionSet& set, const JointFit& fit, const Matrix& covariance,
                     double rate, double reach) {
  ResidualMap map;
  map.false_discovery_rate = rate;
  const Vector r = fit.residuals();
  const Matrix w = averages(fit, reach);
  const Vector mean = w * r;
  const Vector variance = (w * after_fit(fit, covariance)).cwiseProduct(w).rowwise().sum();
  std::vector<double> p;
  Eigen::Index row = 0;
  for (size_t k = 0; k < fit.conditions.size(); ++k) {
    const FittedCondition& c = fit.conditions[k];
    const TongueLine line(set.model(k));
    for (const auto& of : c.residuals.rows) {
      const double z = mean[row] / std::sqrt(std::max(1e-12, variance[row]));
      const Vec3 place = c.residuals.places[size_t(of.point)];
      map.points.push_back(
          {set.members()[k], place, r[row] / of.scale, z, false, place_name(line, c.x, place)});
      p.push_back(std::erfc(std::abs(z) / std::numbers::sqrt2));
      ++row;
    }
  }
  const double t = threshold(p, rate);
  for (size_t i = 0; i < p.size(); ++i) map.points[i].beyond = p[i] <= t && t > 0;
  map.patches = patches_of(map.points);
  return map;
}

HiddenForce hidden_force(const ConditionSet& set, const std::vector<Matrix>& influences,
                         const Projection& projection, double length) {
  const HexMesh& mesh = set.model(0).mesh;
  const auto n = Eigen::Index(mesh.nodes.size());
  // A body force acts on the volume that a node stands for.
  const Vector volume = tissue_mass(mesh, 1.0) * Vector::Ones(n);
  Matrix field(n, n);
  for (Eigen::Index a = 0; a < n; ++a)
    for (Eigen::Index b = 0; b <= a; ++b)
      field(a, b) = field(b, a) =
          volume[a] * volume[b] *
          std::exp(-0.5 * (mesh.nodes[size_t(a)] - mesh.nodes[size_t(b)]).squaredNorm() /
                   (length * length));
  Eigen::Index rows = 0;
  for (const Matrix& a : influences) rows += a.rows();
  Matrix all(rows, 3 * n);
  rows = 0;
  for (const Matrix& a : influences) all.middleRows(rows, a.rows()) = a, rows += a.rows();
  Matrix kernel = Matrix::Zero(rows, rows);
  std::vector<Matrix> spread;  // of each axis: field times the influence's transpose
  for (int axis = 0; axis < 3; ++axis) {
    const Matrix part = all(Eigen::all, Eigen::seqN(axis, n, 3));
    spread.push_back(field * part.transpose());
    kernel += part * spread.back();
  }
  Matrix share = Matrix::Constant(rows, rows, 0.5);
  Eigen::Index first = 0;
  for (const Matrix& a : influences) {
    share.block(first, first, a.rows(), a.rows()).setOnes();
    first += a.rows();
  }
  const Matrix w = projection(Matrix::Identity(rows, rows));
  const Matrix seen = w * kernel.cwiseProduct(share) * w.transpose();
  const Eigen::SelfAdjointEigenSolver<Matrix> eigen(0.5 * (seen + seen.transpose()));
  const Vector u = eigen.eigenvectors().transpose() * projection.residuals();
  const Vector s = eigen.eigenvalues().cwiseMax(0.0);
  HiddenForce result;
  double best = 0;
  const double unit = s.mean() > 0 ? 1 / s.mean() : 0;
  for (double size = 1e-6 * unit; size < 1e6 * unit; size *= 1.5) {
    const Vector v = Vector::Ones(s.size()) + size * s;
    const double gain =
        0.5 * (u.squaredNorm() - (u.cwiseAbs2().cwiseQuotient(v)).sum() - v.array().log().sum());
    if (gain > result.log_evidence) result.log_evidence = gain, best = size;
  }
  const Vector weights = eigen.eigenvectors() * u.cwiseQuotient(Vector::Ones(s.size()) + best * s);
  const Vector back = w.transpose() * weights;
  result.common = Forces::Zero(3 * n);
  first = 0;
  for (const Matrix& a : influences) {
    Vector here = 0.5 * back;
    here.segment(first, a.rows()) *= 2;
    first += a.rows();
    Forces f(3 * n);
    for (int axis = 0; axis < 3; ++axis)
      f(Eigen::seqN(axis, n, 3)) = -best * (spread[size_t(axis)] * here);
    result.common += f / double(influences.size());
    result.nodal.push_back(std::move(f));
  }
  for (Eigen::Index a = 0; a < n; ++a) {
    const Vec3 f = result.common.segment<3>(3 * a);
    result.resultant += f, result.total += f.norm();
    result.centre += f.norm() * mesh.nodes[size_t(a)];
  }
  if (result.total > 0) result.centre /= result.total;
  const Model& model = set.model(0);
  result.region = place_name(TongueLine(model), model.rest, result.centre);
  return result;
}

}  // namespace genio
