#include "bench/problems/densest_penetration.hpp"

#include <algorithm>

namespace genio::bench {
namespace {

/// Of one face, where it may be deeper than `known` [m].
double depth_of(const ContactFace& face, const BoneDistance& distance, const Positions& x,
                double known) {
  Vec3 centre = Vec3::Zero();
  for (const int n : face.nodes) centre += 0.25 * node_position(x, n);
  double radius = 0;
  for (const int n : face.nodes) radius = std::max(radius, (node_position(x, n) - centre).norm());
  int near = -1;
  if (distance(centre, near) > radius - known) return known;
  for (const ContactPoint& point : face.points) {
    if (point.area == 0) continue;
    const double gap = distance(blend(x, face.nodes, point.weight), near);
    known = std::max(known, std::min(0.0, point.clearance) - gap);
  }
  return known;
}

}  // namespace

DensestPenetration::DensestPenetration(const ModelDescription& d) {
  for (const auto& [name, surface] : {std::pair{"palate", &d.palate}, {"jaw", &d.jaw}})
    if (*surface) bones_.emplace(name, contact_faces(**surface, d.mesh, d.supports, 2e-4));
}

std::map<std::string, double> DensestPenetration::operator()(const Positions& x) const {
  std::map<std::string, double> result;
  for (const auto& [name, bone] : bones_) {
    double deepest = 0;
    for (const ContactFace& face : bone->faces)
      deepest = depth_of(face, bone->field->exact(), x, deepest);
    result[name] = deepest;
  }
  return result;
}

}  // namespace genio::bench
