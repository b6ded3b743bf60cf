#pragma once
#include <memory>

#include "forward/effects/tissue/elasticity.hpp"

namespace genio {

/// The part of Rayleigh damping that goes with the tissue's stiffness: R = 1/2 beta v.K(x) v, K
/// that of the elasticity in the shape x. It has no parameter of its own; it borrows the
/// elasticity's a10, a20, kappa [Pa] and the viscosity's beta [s].
class TissueViscosity final : public Dissipation, public JointForces {
 public:
  explicit TissueViscosity(std::shared_ptr<const Elasticity> elasticity)
      : elasticity_(std::move(elasticity)) {}

  std::string_view name() const override { return "elasticity"; }
  std::span<const ParameterInfo> parameters() const override { return {}; }
  std::vector<ParameterName> borrows() const override;
  void add_viscous_force(const Positions& x, const Vector& v, EffectParameters p,
                         Forces& f) const override;
  void add_damping(const Positions& x, const Vector& v, EffectParameters p,
                   Stiffness& c) const override;
  void add_viscous_force_slope(const Positions& x, const Vector& v, EffectParameters p,
                               const Matrix& along, Stiffness& scratch, Matrix& df) const override;
  void add_viscous_force_derivative(const Positions& x, const Vector& v, EffectParameters p, int k,
                                    Forces& df) const override;
  /// Each element is deformed once for both forces.
  void add_forces(const Positions& x, const Vector& v, EffectParameters p, Forces& f,
                  Forces& viscous) const override;

 private:
  std::shared_ptr<const Elasticity> elasticity_;
};

}  // namespace genio
