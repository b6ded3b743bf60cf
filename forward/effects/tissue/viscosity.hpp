#pragma once
#include <array>

#include "forward/effects/kind.hpp"
#include "forward/geometry/mesh.hpp"

namespace genio {

/// Rayleigh damping, R = 1/2 v.(alpha M + beta K) v with the mass M of the tissue and the stiffness
/// K of its elasticity in the shape x (the seed model's C = alpha M + beta K; Buchaillard et al.
/// 2009: alpha 40 1/s, beta 0.03 s). This class computes the part with M; TissueViscosity borrows
/// beta for the part with K. Parameters: alpha [1/s], beta [s].
class Viscosity final : public Dissipation {
 public:
  Viscosity(const NodeMatrix& mass, double alpha, double beta);

  std::string_view name() const override { return "viscosity"; }
  std::span<const ParameterInfo> parameters() const override { return info_; }
  void add_viscous_force(const Positions& x, const Vector& v, EffectParameters p,
                         Forces& f) const override;
  void add_damping(const Positions& x, const Vector& v, EffectParameters p,
                   Stiffness& c) const override;
  /// Nothing: the force is the same in every shape.
  void add_viscous_force_slope(const Positions&, const Vector&, EffectParameters, const Matrix&,
                               Stiffness&, Matrix&) const override {}
  void add_viscous_force_derivative(const Positions& x, const Vector& v, EffectParameters p, int k,
                                    Forces& df) const override;

 private:
  NodeMatrix mass_;
  std::array<ParameterInfo, 2> info_;
};

EffectKind viscosity_kind();

}  // namespace genio
