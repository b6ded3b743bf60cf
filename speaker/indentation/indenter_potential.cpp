#include "speaker/indentation/indenter_potential.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>

#include "forward/geometry/quad4.hpp"

namespace genio {
namespace {

constexpr int by_depth = 0;

/// act(face, Gauss point, its area at rest) of a quadrilateral.
template <class Act>
void each_gauss_point(const HexMesh& mesh, const Quad& face, Act act) {
  for (const auto& q : quad4::gauss_points()) {
    Vec3 u = Vec3::Zero(), v = Vec3::Zero();
    for (size_t a = 0; a < 4; ++a) {
      const Vec3& at = mesh.nodes[size_t(face[a])];
      u += q.by[a][0] * at, v += q.by[a][1] * at;
    }
    act(q, u.cross(v).norm());
  }
}

double top_of(const IndentedBlock& block) { return block.mesh.nodes[size_t(block.centre)][2]; }

}  // namespace

IndenterPotential::IndenterPotential(const char* unit, double stiffness)
    : info_{{{.name = "depth", .unit = "m", .lower = 0, .upper = 1, .load = true},
             {.name = "stiffness",
              .unit = unit,
              .value = stiffness,
              .lower = 0,
              .upper = 1e15,
              .penalty = true}}} {}

RigidIndenter::RigidIndenter(const IndentedBlock& block, const IndentationExperiment& e,
                             double stiffness)
    : IndenterPotential("Pa/m", stiffness),
      top_(top_of(block)),
      radius_(e.indenter == Indenter::sphere ? e.radius : 0) {
  for (size_t i = 0; i < block.top.size(); ++i)
    if (radius_ > 0 || block.pressed[i])
      each_gauss_point(block.mesh, block.top[i], [&](const quad4::Point& q, double area) {
        points_.push_back({block.top[i], q.value, area});
      });
}

RigidIndenter::Touch RigidIndenter::touch(const Point& point, const Positions& x,
                                          double depth) const {
  Vec3 at = Vec3::Zero();
  for (size_t a = 0; a < 4; ++a) at += point.weight[a] * node_position(x, point.nodes[a]);
  if (radius_ == 0) return {at[2] - (top_ - depth), Vec3(0, 0, -1), 0};
  const Vec3 from = at - Vec3(0, 0, top_ + radius_ - depth);
  const double r = std::max(from.norm(), 1e-3 * radius_);
  return {radius_ - r, from / r, 1 / r};
}

template <class Act>
void RigidIndenter::each_touching_point(const Positions& x, double depth, Act act) const {
  for (const Point& point : points_)
    if (const Touch t = touch(point, x, depth); t.depth > 0) act(point, t);
}

double RigidIndenter::energy(const Positions& x, EffectParameters p) const {
  double e = 0;
  each_touching_point(x, p[0], [&](const Point& point, const Touch& t) {
    e += 0.5 * p[1] * point.area * t.depth * t.depth;
  });
  return e;
}

void RigidIndenter::add_force(const Positions& x, EffectParameters p, Forces& f) const {
  each_touching_point(x, p[0], [&](const Point& point, const Touch& t) {
    for (size_t a = 0; a < 4; ++a)
      f.segment<3>(3 * point.nodes[a]) += p[1] * point.area * t.depth * point.weight[a] * t.normal;
  });
}

void RigidIndenter::add_stiffness(const Positions& x, EffectParameters p, Stiffness& k) const {
  each_touching_point(x, p[0], [&](const Point& point, const Touch& t) {
    const Mat3 nn = t.normal * t.normal.transpose();
    const Mat3 s = p[1] * point.area * (nn - t.depth * t.bend * (Mat3::Identity() - nn));
    for (size_t a = 0; a < 4; ++a)
      for (size_t b = 0; b <= a; ++b)
        k.add(point.nodes[a], point.nodes[b], point.weight[a] * point.weight[b] * s);
  });
}

// The penetration r0 - |x - c| grows with the depth by the normal's part downwards.
void RigidIndenter::add_force_derivative(const Positions& x, EffectParameters p, int k,
                                         Forces& df) const {
  each_touching_point(x, p[0], [&](const Point& point, const Touch& t) {
    Vec3 change = t.depth * t.normal;
    if (k == by_depth) {
      // The centre moves downwards: so does, seen from it, the point upwards.
      const Vec3 up(0, 0, 1);
      change = p[1] * (-up.dot(t.normal) * t.normal +
                       t.depth * t.bend * (up - up.dot(t.normal) * t.normal));
    }
    for (size_t a = 0; a < 4; ++a)
      df.segment<3>(3 * point.nodes[a]) += point.area * point.weight[a] * change;
  });
}

double RigidIndenter::pressing(const Positions& x, EffectParameters p) const {
  double force = 0;
  each_touching_point(x, p[0], [&](const Point& point, const Touch& t) {
    force -= p[1] * point.area * t.depth * t.normal[2];
  });
  return force;
}

double RigidIndenter::pressing_slope(const Positions& x, EffectParameters p) const {
  double slope = 0;
  each_touching_point(x, p[0], [&](const Point& point, const Touch& t) {
    const double n2 = t.normal[2] * t.normal[2];
    slope += p[1] * point.area * (n2 - t.depth * t.bend * (1 - n2));
  });
  return slope;
}

PressurePatch::PressurePatch(const IndentedBlock& block, double stiffness)
    : IndenterPotential("N/m", stiffness), top_(top_of(block)) {
  std::map<int, double> areas;
  double whole = 0;
  for (size_t i = 0; i < block.top.size(); ++i)
    if (block.pressed[i])
      each_gauss_point(block.mesh, block.top[i], [&](const quad4::Point& q, double area) {
        for (size_t a = 0; a < 4; ++a) areas[block.top[i][a]] += area * q.value[a];
        whole += area;
      });
  for (const auto& [node, area] : areas) weights_.emplace_back(node, area / whole);
}

std::vector<std::pair<int, int>> PressurePatch::couplings() const {
  std::vector<std::pair<int, int>> pairs;
  for (size_t a = 0; a < weights_.size(); ++a)
    for (size_t b = 0; b < a; ++b) pairs.emplace_back(weights_[a].first, weights_[b].first);
  return pairs;
}

double PressurePatch::short_by(const Positions& x, double depth) const {
  for (const auto& [node, part] : weights_) depth -= part * (top_ - x[3 * node + 2]);
  return depth;
}

double PressurePatch::energy(const Positions& x, EffectParameters p) const {
  const double s = short_by(x, p[0]);
  return 0.5 * p[1] * s * s;
}

void PressurePatch::add_force(const Positions& x, EffectParameters p, Forces& f) const {
  const double s = p[1] * short_by(x, p[0]);
  for (const auto& [node, part] : weights_) f[3 * node + 2] -= s * part;
}

void PressurePatch::add_stiffness(const Positions&, EffectParameters p, Stiffness& k) const {
  Mat3 s = Mat3::Zero();
  for (size_t a = 0; a < weights_.size(); ++a)
    for (size_t b = 0; b <= a; ++b) {
      s(2, 2) = p[1] * weights_[a].second * weights_[b].second;
      k.add(weights_[a].first, weights_[b].first, s);
    }
}

void PressurePatch::add_force_derivative(const Positions& x, EffectParameters p, int k,
                                         Forces& df) const {
  const double s = k == by_depth ? p[1] : short_by(x, p[0]);
  for (const auto& [node, part] : weights_) df[3 * node + 2] -= s * part;
}

double PressurePatch::pressing(const Positions& x, EffectParameters p) const {
  return p[1] * short_by(x, p[0]);
}

std::shared_ptr<const IndenterPotential> indenter_potential(const IndentedBlock& block,
                                                            const IndentationExperiment& e,
                                                            double stiffness) {
  if (e.indenter == Indenter::pressure) return std::make_shared<PressurePatch>(block, stiffness);
  return std::make_shared<RigidIndenter>(block, e, stiffness);
}

}  // namespace genio
