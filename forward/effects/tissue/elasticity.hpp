#pragma once
#include <array>

#include "forward/effects/tissue/tissue_effect.hpp"

namespace genio {

struct TissueConstants {
  double a10 = 1037;       ///< [Pa] living tongue (Buchaillard et al. 2009)
  double a20 = 486;        ///< [Pa]
  double kappa = 1037000;  ///< bulk modulus [Pa]; at least 1000 a10 keeps the volume to 0.1 %
};

/// Passive tissue: the same Yeoh law everywhere (batch_energy). Parameters: a10, a20, kappa [Pa].
///
/// Where a viscosity effect is present, its part that goes with the stiffness is carried here, next
/// to the kernels: R = 1/2 beta v.K(x) v with its parameter beta [s], borrowed.
class Elasticity final : public TissueEffect {
 public:
  Elasticity(const HexMesh& mesh, const TissueConstants& constants, bool viscous = false);

  std::string_view name() const override { return "elasticity"; }
  std::span<const ParameterInfo> parameters() const override { return info_; }
  std::vector<std::string> borrows() const override;
  void add_viscous_force(const Positions& x, const Vector& v, EffectParameters p,
                         Forces& f) const override;
  void add_forces_in_motion(const Positions& x, const Vector& v, EffectParameters p, Forces& f,
                            Forces& viscous) const override;
  void add_damping(const Positions& x, const Vector& v, EffectParameters p,
                   Stiffness& c) const override;
  void add_viscous_force_slope(const Positions& x, const Vector& v, EffectParameters p,
                               const Matrix& along, Stiffness& scratch, Matrix& df) const override;
  void add_viscous_force_derivative(const Positions& x, const Vector& v, EffectParameters p, int k,
                                    Forces& df) const override;
  /// No Gauss point loses more than three quarters of its volume in one step.
  double step_limit(const Positions& x, const Positions& along, EffectParameters) const override;

 private:
  BatchTissue tissue(size_t, EffectParameters p) const override {
    return BatchTissue::uniform(p[0], p[1], 0, p[2]);
  }
  BatchTissue tissue_derivative(size_t, EffectParameters, int k) const override {
    return BatchTissue::uniform(k == 0, k == 1, 0, k == 2);
  }

  double beta(EffectParameters p) const { return viscous_ ? p[3] : 0; }

  bool viscous_;
  std::array<ParameterInfo, 3> info_;
};

}  // namespace genio
