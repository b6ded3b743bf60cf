#pragma once
#include <array>

#include "forward/effects/kind.hpp"
#include "forward/tissue/fibre_field.hpp"
#include "forward/tissue/fibres.hpp"

namespace genio {

/// Passive tissue that resists stretch along its muscle fibres.
///
/// W = modulus/4 phi(I4 - 1), I4 = |F a0|^2, phi a SoftSpring over the first `toe` = 0.1 (crimped
/// fibres bear little until they are straight), for every muscle that runs through an element, each
/// with an equal share of its volume: interwoven families (Wilhelms-Tricarico 1995; Takemoto 2001).
/// For small strains beyond the toe, `modulus` is Young's modulus along the fibres on top of the
/// tissue's. Parameter: modulus [Pa].
class FibreAnisotropy final : public Potential {
 public:
  FibreAnisotropy(const HexMesh& mesh, const std::vector<Muscle>& muscles, double modulus);

  std::string_view name() const override { return "fibre_anisotropy"; }
  std::span<const ParameterInfo> parameters() const override { return info_; }
  double energy(const Positions& x, EffectParameters p) const override;
  void add_force(const Positions& x, EffectParameters p, Forces& f) const override;
  void add_stiffness(const Positions& x, EffectParameters p, Stiffness& k) const override;
  void add_force_derivative(const Positions& x, EffectParameters p, int k,
                            Forces& df) const override;

 private:
  std::vector<FibreSample> samples_;
  std::array<ParameterInfo, 1> info_;
};

/// Mean direction of a muscle's fibres at rest about a point: the principal axis of its segments,
/// nearer ones counting more, those across the midsagittal plane y = 0 not at all: fibres meet in a
/// septum there, and half a tongue has only its own. All count where a muscle has none on
/// the point's side.
Vec3 fibre_direction(const Muscle& muscle, const Positions& rest, const Vec3& point);

EffectKind fibre_anisotropy_kind();

}  // namespace genio
