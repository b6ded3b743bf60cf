#pragma once
#include <array>

#include "forward/algebra/supports.hpp"
#include "forward/effects/kind.hpp"
#include "forward/geometry/mesh.hpp"

namespace genio {

/// Air pressure on the faces of the tongue that look up or back, following them as they move.
///
/// E = pressure * integral over the faces of (x - c).d (n.d) da, with c the centroid and d the
/// normal of the faces' rim at rest: the volume between the faces and the plane of their rim.
/// Inside the patch that is pressure along the present normal; on a rim out of that plane it adds
/// the pressure on the curtain from rim to plane, which keeps the load conservative. Half a tongue
/// has the plane of the whole; where it was cut is no rim. Parameter: pressure [Pa], above that
/// outside.
class AirwayPressure final : public Potential {
 public:
  AirwayPressure(const HexMesh& mesh, const std::vector<Support>& supports, std::vector<Quad> faces,
                 double pressure);

  std::string_view name() const override { return "airway_pressure"; }
  std::span<const ParameterInfo> parameters() const override { return info_; }
  double energy(const Positions& x, EffectParameters p) const override;
  void add_force(const Positions& x, EffectParameters p, Forces& f) const override;
  void add_stiffness(const Positions& x, EffectParameters p, Stiffness& k) const override;
  void add_force_derivative(const Positions& x, EffectParameters p, int k,
                            Forces& df) const override;

 private:
  std::vector<Quad> faces_;
  Vec3 centre_, normal_;
  std::array<ParameterInfo, 1> info_;
};

EffectKind airway_pressure_kind();

}  // namespace genio
