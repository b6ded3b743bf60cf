#include "forward/effects/muscles.hpp"

#include <Eigen/Dense>

namespace genio {

Muscles::Muscles(std::vector<Muscle> muscles) : muscles_(std::move(muscles)) {
  for (const Muscle& m : muscles_) info_.push_back({m.name, "N", 0, 0, m.max_force, 0, true});
}

double Muscles::energy(const Positions& x, EffectParameters p) const {
  double e = 0;
  for (size_t k = 0; k < muscles_.size(); ++k) {
    if (p[k] == 0) continue;
    double length = 0;
    for (const auto& s : muscles_[k].segments)
      length += s.share * (s.end.position(x) - s.start.position(x)).norm();
    e += p[k] * length;
  }
  return e;
}

void Muscles::add_tension(const Positions& x, int muscle, double tension, Forces& f) const {
  for (const auto& s : muscles_[muscle].segments) {
    const Vec3 pull =
        tension * s.share * (s.end.position(x) - s.start.position(x)).normalized();
    if (s.start.node >= 0) f.segment<3>(3 * s.start.node) += pull;
    if (s.end.node >= 0) f.segment<3>(3 * s.end.node) -= pull;
  }
}

void Muscles::add_force(const Positions& x, EffectParameters p, Forces& f) const {
  for (size_t k = 0; k < muscles_.size(); ++k)
    if (p[k] != 0) add_tension(x, int(k), p[k], f);
}

void Muscles::add_force_derivative(const Positions& x, EffectParameters, int k,
                                   Forces& df) const {
  add_tension(x, k, 1.0, df);
}

void Muscles::add_stiffness(const Positions& x, EffectParameters p, Stiffness& stiffness) const {
  for (size_t k = 0; k < muscles_.size(); ++k) {
    if (p[k] == 0) continue;
    for (const auto& s : muscles_[k].segments) {
      const Vec3 d = s.end.position(x) - s.start.position(x);
      const double length = d.norm();
      const Vec3 t = d / length;
      const Mat3 block = p[k] * s.share / length * (Mat3::Identity() - t * t.transpose());
      const int a = s.start.node, b = s.end.node;
      if (a >= 0) stiffness.add(a, a, block);
      if (b >= 0) stiffness.add(b, b, block);
      if (a >= 0 && b >= 0) stiffness.add(a, b, -block);
    }
  }
}

std::vector<std::pair<int, int>> Muscles::couplings() const {
  std::vector<std::pair<int, int>> pairs;
  for (const auto& m : muscles_)
    for (const auto& s : m.segments)
      if (s.start.node >= 0 && s.end.node >= 0) pairs.emplace_back(s.start.node, s.end.node);
  return pairs;
}

}  // namespace genio
