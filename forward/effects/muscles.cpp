#include "forward/effects/muscles.hpp"

#include <Eigen/Dense>

namespace genio {
namespace {

/// phi, phi' / L and phi'' of a segment of length L.
struct Pull {
  double value, slope_over_length, curvature;
  Pull(double length, double short_length) {
    if (length >= short_length) {
      value = length, slope_over_length = 1 / length, curvature = 0;
      return;
    }
    const double s2 = length * length / (short_length * short_length);
    value = short_length * (3.0 / 8 + s2 * (3.0 / 4 - s2 / 8));
    slope_over_length = (1.5 - 0.5 * s2) / short_length;
    curvature = 1.5 * (1 - s2) / short_length;
  }
};

}  // namespace

Muscles::Muscles(std::vector<Muscle> muscles) : muscles_(std::move(muscles)) {
  for (const Muscle& m : muscles_) info_.push_back({m.name, "N", 0, 0, m.max_force, 0, true});
}

double Muscles::energy(const Positions& x, EffectParameters p) const {
  double e = 0;
  for (size_t k = 0; k < muscles_.size(); ++k) {
    if (p[k] == 0) continue;
    double length = 0;
    for (const auto& s : muscles_[k].segments)
      length +=
          s.share * Pull((s.end.position(x) - s.start.position(x)).norm(), s.short_length).value;
    e += p[k] * length;
  }
  return e;
}

void Muscles::add_tension(const Positions& x, int muscle, double tension, Forces& f) const {
  for (const auto& s : muscles_[muscle].segments) {
    const Vec3 d = s.end.position(x) - s.start.position(x);
    const Vec3 pull = tension * s.share * Pull(d.norm(), s.short_length).slope_over_length * d;
    if (s.start.node >= 0) f.segment<3>(3 * s.start.node) += pull;
    if (s.end.node >= 0) f.segment<3>(3 * s.end.node) -= pull;
  }
}

void Muscles::add_force(const Positions& x, EffectParameters p, Forces& f) const {
  for (size_t k = 0; k < muscles_.size(); ++k)
    if (p[k] != 0) add_tension(x, int(k), p[k], f);
}

void Muscles::add_force_derivative(const Positions& x, EffectParameters, int k, Forces& df) const {
  add_tension(x, k, 1.0, df);
}

void Muscles::add_stiffness(const Positions& x, EffectParameters p, Stiffness& stiffness) const {
  for (size_t k = 0; k < muscles_.size(); ++k) {
    if (p[k] == 0) continue;
    for (const auto& s : muscles_[k].segments) {
      const Vec3 d = s.end.position(x) - s.start.position(x);
      const Pull pull(d.norm(), s.short_length);
      const Vec3 t = d.normalized();  // 0 for a segment of no length
      const Mat3 along = t * t.transpose();
      const Mat3 block =
          p[k] * s.share *
          (pull.curvature * along + pull.slope_over_length * (Mat3::Identity() - along));
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
