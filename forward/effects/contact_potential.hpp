#pragma once
#include <span>

#include "forward/effects/description.hpp"
#include "forward/effects/potential.hpp"

namespace genio {

/// The potential of a contact, which may also be asked how near its surface is.
class ContactPotential : public Potential {
 public:
  /// Signed distance of a point from the surface as it lies at rest, positive on the tongue's side
  /// [m].
  virtual double distance(const Vec3& point) const = 0;
  /// Deepest penetration in the shape `x` beyond the overlap at rest [m], >= 0.
  virtual double max_penetration(const Positions& x, EffectParameters p) const = 0;
  /// Adds how the force changes while tongue, rest configuration and bone move together along each
  /// of some modes of anatomy: 3 n x modes [N per standard deviation]. `rest`: the rest
  /// configuration [m].
  virtual void add_force_along(const Positions& x, EffectParameters p, const Positions& rest,
                               std::span<const AnatomyMode* const> modes, Matrix& df) const = 0;
};

}  // namespace genio
