#include "inverse/target.hpp"

#include <Eigen/Dense>
#include <cmath>
#include <limits>

#include "forward/closest_point.hpp"

namespace genio {

bool Target::midsagittal() const {
  if (!surface.empty()) return false;
  for (const auto& f : flesh)
    if (!std::isnan(f.position[1]) && std::abs(f.position[1]) > 1e-6) return false;
  return true;
}

Target curve_target(const Model& model, const Positions& x, int count, double sigma) {
  Target t;
  for (const Vec2& q : TongueLine(model).sample(x, count)) t.curve.push_back({q, sigma});
  return t;
}

Comparison::Comparison(const Model& model, Target target)
    : model_(&model), target_(std::move(target)), line_(model) {}

void Comparison::compare_surface(const Positions& x, Residuals& r) const {
  // Few hundred faces against few hundred points: a tree over a moving surface would not pay.
  std::vector<std::array<int, 3>> triangles;
  for (const Quad& q : model_->surface) {
    triangles.push_back({q[0], q[1], q[2]});
    triangles.push_back({q[0], q[2], q[3]});
  }
  for (const auto& point : target_.surface) {
    double best = std::numeric_limits<double>::infinity();
    size_t index = 0;
    std::array<double, 3> weight{};
    Vec3 foot = Vec3::Zero();
    for (size_t t = 0; t < triangles.size(); ++t) {
      const auto& n = triangles[t];
      const Vec3 a = node_position(x, n[0]), b = node_position(x, n[1]), c = node_position(x, n[2]);
      const auto w = closest_on_triangle(point.position, a, b, c);
      const Vec3 f = w[0] * a + w[1] * b + w[2] * c;
      if (const double d = (point.position - f).squaredNorm(); d < best)
        best = d, index = t, weight = w, foot = f;
    }
    const auto& n = triangles[index];
    const Vec3 face = (node_position(x, n[1]) - node_position(x, n[0]))
                          .cross(node_position(x, n[2]) - node_position(x, n[0]))
                          .normalized();
    // Signed along the line to the foot point, which is the face's normal inside a face.
    Vec3 normal = point.position - foot;
    const double distance = normal.norm();
    normal = distance > 1e-9 ? Vec3(normal / distance) : face;
    const double sign = normal.dot(face) >= 0 ? 1.0 : -1.0;
    r.values[Eigen::Index(r.gradient.size())] = sign * distance / point.sigma;
    std::vector<std::pair<int, Vec3>> row;
    for (int k = 0; k < 3; ++k) row.emplace_back(n[k], -sign * weight[k] / point.sigma * normal);
    r.gradient.push_back(std::move(row));
    r.distances[Eigen::Index(r.places.size())] = distance;
    r.places.push_back(foot);
  }
}

Residuals Comparison::operator()(const Positions& x) const {
  Residuals r;
  Eigen::Index rows = Eigen::Index(target_.curve.size() + target_.surface.size());
  for (const auto& f : target_.flesh) rows += std::isnan(f.position[1]) ? 2 : 3;
  r.values.resize(rows);
  r.distances.resize(
      Eigen::Index(target_.curve.size() + target_.flesh.size() + target_.surface.size()));
  const auto& nodes = line_.nodes();
  for (const auto& point : target_.curve) {
    const auto c = line_.closest(x, point.position);
    const Vector w = line_.weights(c.t);
    r.values[Eigen::Index(r.gradient.size())] = c.distance / point.sigma;
    std::vector<std::pair<int, Vec3>> row;
    for (size_t k = 0; k < nodes.size(); ++k) {
      const Vec2 g = -w[Eigen::Index(k)] / point.sigma * c.normal;
      row.emplace_back(nodes[k], Vec3(g[0], 0, g[1]));
    }
    r.gradient.push_back(std::move(row));
    r.distances[Eigen::Index(r.places.size())] = std::abs(c.distance);
    const Vec2 foot = point.position - c.distance * c.normal;
    r.places.emplace_back(foot[0], 0, foot[1]);
  }
  for (const auto& point : target_.flesh) {
    Vec3 off = node_position(x, point.node) - point.position;
    for (int i = 0; i < 3; ++i) {
      if (std::isnan(off[i])) {
        off[i] = 0;
        continue;
      }
      r.values[Eigen::Index(r.gradient.size())] = off[i] / point.sigma;
      r.gradient.push_back({{point.node, Vec3::Unit(i) / point.sigma}});
    }
    r.distances[Eigen::Index(r.places.size())] = off.norm();
    r.places.push_back(node_position(x, point.node));
  }
  compare_surface(x, r);
  if (r.distances.size() > 0) {
    r.rms = std::sqrt(r.distances.squaredNorm() / double(r.distances.size()));
    r.max = r.distances.maxCoeff();
  }
  return r;
}

Matrix residual_jacobian(const Residuals& residuals, const Matrix& positions) {
  Matrix j = Matrix::Zero(Eigen::Index(residuals.gradient.size()), positions.cols());
  for (size_t i = 0; i < residuals.gradient.size(); ++i)
    for (const auto& [node, g] : residuals.gradient[i])
      j.row(Eigen::Index(i)) += g.transpose() * positions.middleRows<3>(3 * node);
  return j;
}

}  // namespace genio
