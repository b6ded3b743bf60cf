#pragma once
// What presses on a block: a rigid surface that touches, or a pressure whose mean depth is given.

#include <array>
#include <memory>
#include <vector>

#include "forward/effects/potential.hpp"
#include "speaker/indentation/block.hpp"

namespace genio {

/// A potential that falls as the tissue gives way. Parameters: depth d [m], which is prescribed,
/// and stiffness, a penalty large enough that the tissue follows.
class IndenterPotential : public Potential {
 public:
  std::string_view name() const final { return "indenter"; }
  std::span<const ParameterInfo> parameters() const final { return info_; }
  /// dE/dd: the force that the depth takes [N].
  virtual double pressing(const Positions& x, EffectParameters p) const = 0;
  /// d2E/dd2 with the tissue held [N/m].
  virtual double pressing_slope(const Positions& x, EffectParameters p) const = 0;

 protected:
  IndenterPotential(const char* stiffness_unit, double stiffness);

 private:
  std::array<ParameterInfo, 2> info_;
};

/// A rigid, frictionless punch or sphere: E = sum_q A_q stiffness/2 max(0, penetration_q)^2 over
/// the Gauss points of the top's faces, with their areas at rest. Tissue lets go where it would be
/// pulled. Of a punch, the faces that lie below it at rest may touch its flat end. Stiffness in
/// Pa/m.
class RigidIndenter final : public IndenterPotential {
 public:
  RigidIndenter(const IndentedBlock& block, const IndentationExperiment& experiment,
                double stiffness);

  double energy(const Positions& x, EffectParameters p) const override;
  void add_force(const Positions& x, EffectParameters p, Forces& f) const override;
  void add_stiffness(const Positions& x, EffectParameters p, Stiffness& k) const override;
  void add_force_derivative(const Positions& x, EffectParameters p, int k,
                            Forces& df) const override;
  double pressing(const Positions& x, EffectParameters p) const override;
  double pressing_slope(const Positions& x, EffectParameters p) const override;

 private:
  struct Point {
    Quad nodes;
    std::array<double, 4> weight;
    double area;  // [m^2]
  };
  struct Touch {
    double depth;  // below the indenter's surface [m]
    Vec3 normal;   // outwards from the indenter
    double bend;   // curvature of its surface [1/m]
  };
  Touch touch(const Point& point, const Positions& x, double depth) const;
  template <class Act>
  void each_touching_point(const Positions& x, double depth, Act act) const;

  std::vector<Point> points_;
  double top_, radius_;  // [m]; radius 0: flat
};

/// The same pressure on every face of a circle, downwards, by their areas at rest:
/// E = stiffness/2 (d - D)^2 with D the mean depth of the circle. Stiffness in N/m.
class PressurePatch final : public IndenterPotential {
 public:
  PressurePatch(const IndentedBlock& block, double stiffness);

  std::vector<std::pair<int, int>> couplings() const override;
  double energy(const Positions& x, EffectParameters p) const override;
  void add_force(const Positions& x, EffectParameters p, Forces& f) const override;
  void add_stiffness(const Positions& x, EffectParameters p, Stiffness& k) const override;
  void add_force_derivative(const Positions& x, EffectParameters p, int k,
                            Forces& df) const override;
  double pressing(const Positions& x, EffectParameters p) const override;
  double pressing_slope(const Positions&, EffectParameters p) const override { return p[1]; }

 private:
  double short_by(const Positions& x, double depth) const;

  std::vector<std::pair<int, double>> weights_;  // node and its part of the circle's area
  double top_;                                   // [m]
};

std::shared_ptr<const IndenterPotential> indenter_potential(const IndentedBlock& block,
                                                            const IndentationExperiment& experiment,
                                                            double stiffness);

}  // namespace genio
