#include "forward/effects/surroundings/contact_faces.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <deque>
#include <mutex>
#include <numeric>
#include <optional>

#include "forward/tissue/tongue_faces.hpp"

namespace genio {
namespace {

constexpr size_t most_kept = 8;           // 48 bytes a point, 16 points a square millimetre
constexpr double deepest_overlap = 2e-3;  // at rest [m]
constexpr double another_side = 10e-3;    // so near its side of the bone is asked for [m]
static_assert(contact_gap < DistanceField::touch, "what touches is asked for");
constexpr double field_error = 0.3e-3;  // of the spline at an edge [m]

/// The distance that a point keeps [m], below 0 where it overlaps at rest; none where it lies on
/// another side of the bone, behind the plane of the surface's nearest place. `near`: as for
/// SurfaceDistance.
std::optional<double> rest_clearance(const DistanceField& field, const Vec3& at, int& near) {
  if (field.rough(at) > another_side) return contact_gap;
  const auto foot = field.exact().face().foot(at, near);
  if ((at - foot.place).dot(foot.normal.normalized()) <
      -(foot.on_rim ? field_error : deepest_overlap))
    return std::nullopt;
  double distance = field.exact().from(foot, at, near);
  if (distance < contact_gap + field_error) distance = field.value(at);
  return std::min(contact_gap, distance);
}

/// Cells between points along a face: a power of 2.
int cells(const Vec3& side, const Vec3& opposite, double apart) {
  const double length = std::max(side.norm(), opposite.norm());
  return 1 << std::clamp(int(std::lround(std::log2(length / apart))), 0, 6);
}

/// The area that a point stands for [m^2].
double area_of(const ContactFace& face, const std::array<Vec3, 4>& x,
               const std::array<double, 4>& weight) {
  const double u = weight[1] + weight[2], v = weight[2] + weight[3];
  const auto [by_u, by_v] = face_tangents(x, weight);
  // Trapezoidal rule.
  const double part = (u > 0 && u < 1 ? 1 : 0.5) * (v > 0 && v < 1 ? 1 : 0.5);
  return part * by_u.cross(by_v).norm() / (face.cells_u * face.cells_v);
}

ContactFace contact_face(const DistanceField& field, const HexMesh& mesh, const Quad& nodes,
                         const std::vector<Support>& supports, double apart) {
  std::array<Vec3, 4> x;
  std::array<double, 4> moves;
  for (size_t a = 0; a < 4; ++a)
    x[a] = mesh.nodes[size_t(nodes[a])], moves[a] = moves_freely(supports[size_t(nodes[a])]);
  int near = -1;
  ContactFace face{
      nodes, cells(x[1] - x[0], x[2] - x[3], apart), cells(x[3] - x[0], x[2] - x[1], apart), {}};
  for (int j = 0; j <= face.cells_v; ++j)
    for (int i = 0; i <= face.cells_u; ++i) {
      const double u = double(i) / face.cells_u, v = double(j) / face.cells_v;
      ContactPoint point{{(1 - u) * (1 - v), u * (1 - v), u * v, (1 - u) * v}, 0, contact_gap};
      const auto& w = point.weight;
      const auto clearance = rest_clearance(field, blend(x, w), near);
      if (clearance && std::inner_product(w.begin(), w.end(), moves.begin(), 0.0) >= 0.5)
        point.area = area_of(face, x, w), point.clearance = *clearance;
      face.points.push_back(point);
    }
  return face;
}

std::shared_ptr<const ContactFaces> made(const TriangleSurface& surface, const HexMesh& mesh,
                                         const std::vector<Support>& supports, double apart) {
  auto result = std::make_shared<ContactFaces>();
  result->field = bone_field(surface, mesh);
  result->surface = surface;
  std::vector<int>& all = result->nodes;
  for (const Quad& nodes : outer_faces(mesh, supports)) {
    ContactFace face = contact_face(*result->field, mesh, nodes, supports, apart);
    if (std::all_of(face.points.begin(), face.points.end(),
                    [](const ContactPoint& p) { return p.area == 0; }))
      continue;
    all.insert(all.end(), nodes.begin(), nodes.end());
    result->faces.push_back(std::move(face));
  }
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return result;
}

/// Faces and what they are made of.
struct Kept {
  TriangleSurface surface;
  HexMesh mesh;
  std::vector<Support> supports;
  double apart;
  std::shared_ptr<const ContactFaces> faces;
};

}  // namespace

std::shared_ptr<const ContactFaces> contact_faces(const TriangleSurface& surface,
                                                  const HexMesh& mesh,
                                                  const std::vector<Support>& supports,
                                                  double apart) {
  static std::mutex mutex;
  static std::deque<Kept> kept;
  {
    const std::lock_guard lock(mutex);
    for (const Kept& k : kept)
      if (k.surface.vertices == surface.vertices && k.surface.triangles == surface.triangles &&
          k.mesh.nodes == mesh.nodes && k.mesh.elements == mesh.elements &&
          k.supports == supports && k.apart == apart)
        return k.faces;
  }
  auto faces = made(surface, mesh, supports, apart);
  const std::lock_guard lock(mutex);
  kept.push_back({surface, mesh, supports, apart, faces});
  if (kept.size() > most_kept) kept.pop_front();
  return faces;
}

std::shared_ptr<const ContactFaces> moved_faces(const ContactFaces& standing,
                                                const TriangleSurface& surface,
                                                const HexMesh& mesh) {
  auto result = std::make_shared<ContactFaces>(standing);
  result->field = moved_bone_field(*standing.field, surface, mesh);
  result->surface = surface;
  for (ContactFace& face : result->faces) {
    std::array<Vec3, 4> x;
    for (size_t a = 0; a < 4; ++a) x[a] = mesh.nodes[size_t(face.nodes[a])];
    for (ContactPoint& point : face.points) {
      if (point.area == 0) continue;
      const auto& w = point.weight;
      point.area = area_of(face, x, w);
      point.clearance = std::min(contact_gap, result->field->value_if_touching(blend(x, w)));
    }
  }
  return result;
}

}  // namespace genio
