#pragma once
#include <array>

#include "forward/effects/kind.hpp"
#include "forward/geometry/mesh.hpp"

namespace genio {

/// The skin of the tongue: an incompressible Yeoh membrane on its surface.
///
/// E = thickness * integral over the rest area of a10 (I - 3) + a20 (I - 3)^2, I = tr C + 1 / det C
/// with C the in-plane right Cauchy-Green tensor (plane stress; Holzapfel 2000, section 6.5), by
/// 2 x 2 Gauss points a face. Parameters: a10, a20 [Pa], thickness [m].
class MucosaLayer final : public Potential {
 public:
  MucosaLayer(const HexMesh& mesh, const std::vector<Quad>& faces, double a10, double a20,
              double thickness);

  std::string_view name() const override { return "mucosa_layer"; }
  std::span<const ParameterInfo> parameters() const override { return info_; }
  double energy(const Positions& x, EffectParameters p) const override;
  void add_force(const Positions& x, EffectParameters p, Forces& f) const override;
  void add_stiffness(const Positions& x, EffectParameters p, Stiffness& k) const override;
  void add_force_derivative(const Positions& x, EffectParameters p, int k,
                            Forces& df) const override;

 private:
  struct Point {  // a Gauss point of a face
    Quad node;
    std::array<std::array<double, 2>, 4> by;  // shape function derivatives
    Eigen::Matrix2d inverse;                  // of the rest metric G_a . G_b
    double density;                           // its determinant
    double area;                              // [m^2]
  };
  struct State;  // its stretch
  static State state(const Point& point, const Positions& x);

  std::vector<Point> points_;
  std::array<ParameterInfo, 3> info_;
};

EffectKind mucosa_layer_kind();

}  // namespace genio
