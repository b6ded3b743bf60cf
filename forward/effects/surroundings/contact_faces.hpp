#pragma once
// The faces of a tongue that may touch a bone, as points.

#include <array>
#include <memory>
#include <utility>
#include <vector>

#include "forward/algebra/supports.hpp"
#include "forward/geometry/surfaces/bone_field.hpp"

namespace genio {

/// What keeps tongue and bone apart [m]: saliva, of which Collins & Dawes (1987) measured a film of
/// 0.07 to 0.1 mm, and 0.2 mm that round off the bone's edges. A sharper edge catches between the
/// points that touch and holds the tongue where it happens to be.
constexpr double contact_gap = 3e-4;

/// A point of a face that may touch, and the part of the surface that it stands for.
struct ContactPoint {
  std::array<double, 4> weight;  ///< of the face's nodes: bilinear shape functions
  double area;                   ///< [m^2]
  double clearance;  ///< of the bone that it keeps [m]: the gap, or less where it is nearer at rest
};

/// A face with points on a grid of 2^m by 2^n cells, row by row, edges and corners included.
struct ContactFace {
  Quad nodes;
  int cells_u, cells_v;
  std::vector<ContactPoint> points;  ///< those that never touch have no area
};

/// A bone at rest and the tongue's faces that may touch it.
struct ContactFaces {
  std::shared_ptr<const DistanceField> field;
  TriangleSurface surface;  ///< of the bone, that the field is of
  std::vector<ContactFace> faces;
  std::vector<int> nodes;  ///< of the faces, each once
};

/// Points of the tongue's faces `apart` from one another (0.7 to 1.4 times that) so that no edge of
/// the bone lies deep between them. Those that hang on supported nodes by more than half are the
/// attachment's. What overlaps at rest may stay so; what is more than 2 mm behind the surface at
/// rest belongs to another side of the bone and never touches. The latest few are kept, as models
/// that differ in other effects have the same.
std::shared_ptr<const ContactFaces> contact_faces(const TriangleSurface& surface,
                                                  const HexMesh& mesh,
                                                  const std::vector<Support>& supports,
                                                  double apart = 0.25e-3);

/// The same points of a mesh and a surface that have moved: their areas, and what they keep from
/// the bone, are new. Which points there are, and which may touch, is as it was.
std::shared_ptr<const ContactFaces> moved_faces(const ContactFaces& standing,
                                                const TriangleSurface& surface,
                                                const HexMesh& mesh);

/// How the field `x` of a face's four corners changes along the face's two sides, at the point with
/// these weights.
inline std::pair<Vec3, Vec3> face_tangents(const std::array<Vec3, 4>& x,
                                           const std::array<double, 4>& weight) {
  const double u = weight[1] + weight[2], v = weight[2] + weight[3];
  return {(1 - v) * (x[1] - x[0]) + v * (x[2] - x[3]), (1 - u) * (x[3] - x[0]) + u * (x[2] - x[1])};
}

/// A point between four corners by their weights.
inline Vec3 blend(const std::array<Vec3, 4>& x, const std::array<double, 4>& weight) {
  return weight[0] * x[0] + weight[1] * x[1] + weight[2] * x[2] + weight[3] * x[3];
}

/// The corners of a face in the field `x` of all nodes.
inline std::array<Vec3, 4> corners(const Positions& x, const Quad& nodes) {
  return {node_position(x, nodes[0]), node_position(x, nodes[1]), node_position(x, nodes[2]),
          node_position(x, nodes[3])};
}

/// A point of a face by the weights of its nodes, in the field `x` of all nodes.
inline Vec3 blend(const Positions& x, const Quad& nodes, const std::array<double, 4>& weight) {
  return blend(corners(x, nodes), weight);
}

}  // namespace genio
