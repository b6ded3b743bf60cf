#pragma once
#include <array>

#include "forward/effects/effect.hpp"
#include "forward/element_batches.hpp"

namespace genio {

struct TissueConstants {
  double a10 = 1037;       ///< [Pa] living tongue (Buchaillard et al. 2009)
  double a20 = 486;        ///< [Pa]
  double kappa = 1037000;  ///< bulk modulus [Pa]; at least 1000 a10 keeps the volume to 0.1 %
};

/// Passive tissue: Yeoh law with mean dilatation.
///
/// E = sum_e [ sum_q w_q W(I_q) + kappa/2 V_e (v_e/V_e - 1)^2 ]: the law acts on the isochoric
/// part of F at the 8 Gauss points, the volume change on the element's mean, so nearly
/// incompressible tissue does not lock (Q1-P0; Nagtegaal et al. 1974, Simo, Taylor & Pister 1985,
/// pressure condensed). Energy is +infinity when J <= 0 at a Gauss point.
/// Parameters: a10, a20, kappa [Pa].
class Elasticity final : public Effect {
 public:
  Elasticity(const HexMesh& mesh, const TissueConstants& constants);

  std::string_view name() const override { return "elasticity"; }
  std::span<const ParameterInfo> parameters() const override { return info_; }
  double energy(const Positions& x, EffectParameters p) const override;
  void add_force(const Positions& x, EffectParameters p, Forces& f) const override;
  void add_stiffness(const Positions& x, EffectParameters p, Stiffness& k) const override;
  /// The geometric part uses the pressure that the linearisation at `previous` predicted for x, as
  /// if pressures were unknowns of their own: kappa times the volume error that a straight step
  /// leaves would swamp it (Simo & Taylor 1991, Comput. Methods Appl. Mech. Eng. 85, mixed
  /// Newton with the pressure condensed).
  void add_step_stiffness(const Positions& x, const Positions& previous, const Vector& step,
                          EffectParameters p, Stiffness& k) const override;
  void add_force_derivative(const Positions& x, EffectParameters p, int k,
                            Forces& df) const override;

  /// No Gauss point loses more than three quarters of its volume in one step.
  double step_limit(const Positions& x, const Positions& along) const override;

 private:
  using Lane = lanes::Lane;
  using Batch = ElementBatch;
  struct Shape;  // deformation of a batch at all Gauss points
  static bool deform(const Batch& batch, const Positions& x, Shape& shape);
  static Lane predicted_volume(const Batch& batch, const Positions& from, const Vector& step);
  static void add_batch_stiffness(const Batch& batch, const Shape& shape, Lane pressure,
                                  EffectParameters p, Stiffness& k);

  std::vector<Batch> batches_;
  std::array<ParameterInfo, 3> info_;
};

}  // namespace genio
