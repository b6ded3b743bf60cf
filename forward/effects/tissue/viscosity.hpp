#pragma once
#include <array>

#include "forward/effects/effect.hpp"
#include "forward/geometry/mesh.hpp"

namespace genio {

/// Rayleigh damping, R = 1/2 v.(alpha M + beta K) v with the mass M of the tissue and the stiffness
/// K of its elasticity in the shape x (the seed model's C = alpha M + beta K; Buchaillard et al.
/// 2009: alpha 40 1/s, beta 0.03 s). It acts in dynamics only. The part with K is computed by
/// Elasticity, which borrows beta. Parameters: alpha [1/s], beta [s].
class Viscosity final : public Effect {
 public:
  Viscosity(NodeMatrix mass, double alpha, double beta);

  std::string_view name() const override { return "viscosity"; }
  std::span<const ParameterInfo> parameters() const override { return info_; }
  double energy(const Positions&, EffectParameters) const override { return 0; }
  void add_force(const Positions&, EffectParameters, Forces&) const override {}
  void add_stiffness(const Positions&, EffectParameters, Stiffness&) const override {}
  void add_force_derivative(const Positions&, EffectParameters, int, Forces&) const override {}

  void add_viscous_force(const Positions& x, const Vector& v, EffectParameters p,
                         Forces& f) const override;
  void add_damping(const Positions& x, const Vector& v, EffectParameters p,
                   Stiffness& c) const override;
  void add_viscous_force_slope(const Positions&, const Vector&, EffectParameters, const Matrix&,
                               Stiffness&, Matrix&) const override {}  // the same in every shape
  void add_viscous_force_derivative(const Positions& x, const Vector& v, EffectParameters p, int k,
                                    Forces& df) const override;

 private:
  NodeMatrix mass_;
  std::array<ParameterInfo, 2> info_;
};

}  // namespace genio
