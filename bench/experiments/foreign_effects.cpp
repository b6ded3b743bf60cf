#include "bench/experiments/foreign_effects.hpp"

#include <stdexcept>

namespace genio::bench {
namespace {

double bell(double distance, double radius) {
  const double inside = 1 - distance * distance / (radius * radius);
  return inside > 0 ? inside * inside : 0;
}

}  // namespace

Tether::Tether(const HexMesh& mesh, const Vec3& patch, double radius, const Vec3& anchor,
               double slack, double stiffness)
    : anchor_(anchor),
      slack_(slack),
      info_{{{.name = "stiffness", .unit = "N/m", .value = stiffness, .lower = 0, .upper = 1e5}}} {
  double sum = 0;
  for (size_t a = 0; a < mesh.nodes.size(); ++a)
    if (const double w = bell((mesh.nodes[a] - patch).norm(), radius); w > 0)
      nodes_.emplace_back(int(a), w), sum += w;
  if (nodes_.empty()) throw std::invalid_argument("the tether's patch has no node");
  for (auto& [node, w] : nodes_) w /= sum;
}

Vec3 Tether::arm(const Positions& x) const {
  Vec3 m = -anchor_;
  for (const auto& [node, w] : nodes_) m += w * node_position(x, node);
  return m;
}

double Tether::energy(const Positions& x, EffectParameters p) const {
  const double stretch = std::max(0.0, arm(x).norm() - slack_);
  return 0.5 * p[0] * stretch * stretch;
}

void Tether::add_force(const Positions& x, EffectParameters p, Forces& f) const {
  const Vec3 d = arm(x);
  const double length = d.norm(), pull = p[0] * std::max(0.0, length - slack_);
  for (const auto& [node, w] : nodes_) f.segment<3>(3 * node) -= w * pull / length * d;
}

void Tether::add_stiffness(const Positions& x, EffectParameters p, Stiffness& k) const {
  const Vec3 d = arm(x);
  const double length = d.norm();
  if (length <= slack_) return;
  const Mat3 along = d * d.transpose() / (length * length);
  const Mat3 m = p[0] * (along + (length - slack_) / length * (Mat3::Identity() - along));
  for (size_t i = 0; i < nodes_.size(); ++i)
    for (size_t j = 0; j <= i; ++j)
      k.add(nodes_[i].first, nodes_[j].first, nodes_[i].second * nodes_[j].second * m);
}

void Tether::add_force_derivative(const Positions& x, EffectParameters, int, Forces& df) const {
  const double one[] = {1.0};
  add_force(x, one, df);
}

std::vector<std::pair<int, int>> Tether::couplings() const {
  std::vector<std::pair<int, int>> pairs;
  for (const auto& [a, w] : nodes_)
    for (const auto& [b, v] : nodes_)
      if (b < a) pairs.emplace_back(a, b);
  return pairs;
}

HexMesh with_lump(HexMesh mesh, const Vec3& at, const Vec3& outward, double radius, double height) {
  for (Vec3& x : mesh.nodes) x += height * bell((x - at).norm(), radius) * outward.normalized();
  return mesh;
}

}  // namespace genio::bench
