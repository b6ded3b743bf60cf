#include "forward/effects/muscles/force_velocity.hpp"

#include <cmath>

#include "forward/tissue/segment_forces.hpp"

namespace genio {
namespace {

/// f(u) - 1, its integral from 0, and its derivative.
struct Hill {
  double value, integral, slope;
  explicit Hill(double u) {
    if (u < -1) {
      value = -1, slope = 0, integral = Hill(-1.0).integral - (u + 1);
    } else if (u < 0) {
      value = 5 * u / (1 - 4 * u), slope = 5 / ((1 - 4 * u) * (1 - 4 * u));
      integral = -1.25 * u - 5.0 / 16 * std::log1p(-4 * u);
    } else {
      const double d = 1 + 6.25 * u;
      value = 0.8 - 0.8 / d, slope = 5 / (d * d), integral = 0.8 * u - 0.128 * std::log(d);
    }
  }
};

/// Direction, length over which speed counts, and u of a segment.
struct Shortening {
  Vec3 along;
  double scale;  // max_velocity L_rest [m/s]
  double u;
  Shortening(const FibreSegment& s, const Positions& x, const Vector& v, double max_velocity) {
    const auto velocity = [&](const FibrePoint& p) -> Vec3 {
      return p.node >= 0 ? Vec3(node_position(v, p.node)) : Vec3::Zero();
    };
    along = span(s, x).normalized();
    scale = max_velocity * s.short_length / shortest_fibre;
    u = along.dot(velocity(s.end) - velocity(s.start)) / scale;
  }
};

void add_pull(const FibreSegment& s, const Vec3& pull, Forces& f) {
  if (s.start.node >= 0) f.segment<3>(3 * s.start.node) += pull;
  if (s.end.node >= 0) f.segment<3>(3 * s.end.node) -= pull;
}

}  // namespace

ForceVelocity::ForceVelocity(std::vector<Muscle> muscles, double strength, double max_velocity)
    : muscles_(std::move(muscles)),
      info_{{{.name = "strength", .unit = "1", .value = strength, .lower = 0, .upper = 1},
             {.name = "max_velocity",
              .unit = "1/s",
              .value = max_velocity,
              .lower = 0.1,
              .upper = 100,
              .absent = max_velocity}}} {}

std::vector<ParameterName> ForceVelocity::borrows() const { return command_names(muscles_); }

double ForceVelocity::dissipation(const Positions& x, const Vector& v, EffectParameters p) const {
  double r = 0;
  for (size_t k = 0; k < muscles_.size(); ++k)
    for (const auto& s : muscles_[k].segments) {
      const Shortening m(s, x, v, p[1]);
      r += p[0] * p[2 + k] * s.share * m.scale * Hill(m.u).integral;
    }
  return r;
}

void ForceVelocity::add_viscous_force(const Positions& x, const Vector& v, EffectParameters p,
                                      Forces& f) const {
  for (size_t k = 0; k < muscles_.size(); ++k) {
    const double tension = p[0] * p[2 + k];
    if (tension == 0) continue;
    for (const auto& s : muscles_[k].segments) {
      const Shortening m(s, x, v, p[1]);
      add_pull(s, tension * s.share * Hill(m.u).value * m.along, f);
    }
  }
}

void ForceVelocity::add_damping(const Positions& x, const Vector& v, EffectParameters p,
                                Stiffness& c) const {
  for (size_t k = 0; k < muscles_.size(); ++k) {
    const double tension = p[0] * p[2 + k];
    if (tension == 0) continue;
    for (const auto& s : muscles_[k].segments) {
      const Shortening m(s, x, v, p[1]);
      add_between(s, tension * s.share * Hill(m.u).slope / m.scale * m.along * m.along.transpose(),
                  c);
    }
  }
}

void ForceVelocity::add_viscous_force_derivative(const Positions& x, const Vector& v,
                                                 EffectParameters p, int index, Forces& df) const {
  for (size_t k = 0; k < muscles_.size(); ++k) {
    if (index >= 2 && index != int(2 + k)) continue;
    for (const auto& s : muscles_[k].segments) {
      const Shortening m(s, x, v, p[1]);
      const Hill hill(m.u);
      const double slope = index == 0   ? p[2 + k] * hill.value
                           : index == 1 ? -p[0] * p[2 + k] * hill.slope * m.u / p[1]
                                        : p[0] * hill.value;
      add_pull(s, s.share * slope * m.along, df);
    }
  }
}

EffectKind force_velocity_kind() {
  return {.name = "force_velocity",
          .make = [](Settings& s, const Anatomy& a) -> Effect {
            const double strength = s.take("strength", 1), velocity = s.take("max_velocity", 10);
            return {.dissipation = std::make_shared<ForceVelocity>(a.muscles, strength, velocity)};
          },
          .belief = {.parameters = {{.parameter = "strength", .typical = 1}}},
          .sample = {{"strength", 0.8}, {"max_velocity", 4}}};
}

}  // namespace genio
