#include "forward/effects/surroundings/contact_rates.hpp"

#include <Eigen/Geometry>

namespace genio {
namespace {

/// d area / area as corners at rest move by u.
double stretch_of_area(const std::array<Vec3, 4>& rest, const std::array<Vec3, 4>& u,
                       const std::array<double, 4>& weight) {
  const auto [a, b] = face_tangents(rest, weight);
  const auto [da, db] = face_tangents(u, weight);
  const Vec3 normal = a.cross(b);
  return normal.dot(da.cross(b) + a.cross(db)) / normal.squaredNorm();
}

}  // namespace

void add_contact_rates(const ContactSurface& surface, double stiffness, const Positions& x,
                       EffectParameters jaw, const Positions& rest,
                       std::span<const AnatomyMode* const> modes,
                       std::vector<Vec3> AnatomyMode::*of_bone, Matrix& df) {
  std::vector<const std::vector<Vec3>*> of_vertices;
  std::vector<Vector> of_nodes;
  for (const AnatomyMode* mode : modes)
    of_vertices.push_back(&(mode->*of_bone)), of_nodes.push_back(nodal_field(*mode));
  const DistanceField& field = *surface.touchable->field;
  DistanceRates rates(field, surface.touchable->surface, of_vertices);
  const auto add = [&](const ContactFace& face, const auto& points, const PlacedSurface& placed) {
    const auto corners_at_rest = corners(rest, face.nodes);
    for (const TouchingPoint& t : points) {
      const auto& weight = t.point->weight;
      const SoftSpring spring = contact_spring(t.depth);
      const DistanceSample d = placed.sample(t.at);
      const DistanceRates::Rates by_bone = placed.rates(rates, t.at);
      // What overlaps at rest keeps the overlap of the anatomy at hand.
      const bool overlaps = t.point->clearance < contact_gap;
      const Vec3 at_rest = blend(corners_at_rest, weight);
      const Vec3 slope_at_rest = overlaps ? field.sample(at_rest).gradient : Vec3(Vec3::Zero());
      const Vector kept =
          overlaps ? rates.at(at_rest).value : Vector(Vector::Zero(Eigen::Index(modes.size())));
      for (size_t k = 0; k < modes.size(); ++k) {
        const auto column_of = Eigen::Index(k);
        const auto moves = corners(of_nodes[k], face.nodes);
        const Vec3 u = blend(moves, weight);
        const double deeper =
            kept[column_of] + slope_at_rest.dot(u) - by_bone.value[column_of] - d.gradient.dot(u);
        const Vec3 turned = by_bone.gradient.col(column_of) + d.hessian * u;
        const Vec3 force = (stretch_of_area(corners_at_rest, moves, weight) * spring.slope +
                            spring.curvature * deeper) *
                               d.gradient +
                           spring.slope * turned;
        for (size_t a = 0; a < 4; ++a)
          df.col(column_of).segment<3>(3 * face.nodes[a]) +=
              weight[a] * stiffness * t.point->area * force;
      }
    }
  };
  each_touching_face(surface, x, jaw, add);
}

}  // namespace genio
