#pragma once
#include <vector>

#include "forward/effects/newton_aid.hpp"
#include "forward/effects/potential.hpp"
#include "forward/tissue/tissue.hpp"

namespace genio {

/// Energy of Yeoh tissue: all that a derived class says is what each Gauss point is made of, and
/// how that changes with its parameters. Energy, force and stiffness are linear in the constants,
/// so force derivatives are the forces of the constants' derivatives. Energy is +infinity when J <=
/// 0 at a Gauss point.
class TissuePotential : public Potential, public NewtonAid {
 public:
  double energy(const Positions& x, EffectParameters p) const final;
  void add_force(const Positions& x, EffectParameters p, Forces& f) const final;
  void add_stiffness(const Positions& x, EffectParameters p, Stiffness& k) const final;
  /// The geometric part uses the pressure of the predicted dilatation, as if pressures were
  /// unknowns of their own: kappa times the volume error that a straight step leaves would swamp it
  /// (Simo & Taylor 1991, Comput. Methods Appl. Mech. Eng. 85, mixed Newton with the pressure
  /// condensed).
  void add_step_stiffness(const Positions& x, const LinearStep& led, EffectParameters p,
                          Stiffness& k) const final;
  void add_bulk_modulus(EffectParameters p, Vector& kappa) const final;
  const NewtonAid* newton_aid() const final { return this; }
  void add_force_derivative(const Positions& x, EffectParameters p, int k, Forces& df) const final;
  /// Adds the product of the stiffness with `v`, without building the stiffness.
  void add_stiffness_product(const Positions& x, const Vector& v, EffectParameters p,
                             Forces& f) const;

 protected:
  explicit TissuePotential(const HexMesh& mesh) : batches_(element_batches(mesh)) {}

  /// The part of a step over which no Gauss point loses more than three quarters of its volume.
  double volume_step_limit(const Positions& x, const Positions& along) const;

  /// The constants of batch `b`.
  virtual BatchTissue tissue(size_t b, EffectParameters p) const = 0;
  /// Their derivative with respect to parameter k.
  virtual BatchTissue tissue_derivative(size_t b, EffectParameters p, int k) const = 0;
  /// False where it adds nothing to batch `b`, whatever its parameters.
  virtual bool touches(size_t /*b*/) const { return true; }
  /// False where the parameters make it vanish.
  virtual bool present(EffectParameters /*p*/) const { return true; }

  std::vector<ElementBatch> batches_;
};

}  // namespace genio
