#include "forward/effects/surroundings/contact_surface.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <atomic>
#include <cmath>
#include <numeric>
#include <utility>

#include "forward/tissue/tongue_faces.hpp"

namespace genio {
namespace {

constexpr double deepest_overlap = 2e-3;  // at rest [m]
constexpr double another_side = 10e-3;    // so near its side of the bone is asked for [m]
constexpr double field_error = 0.3e-3;    // of the spline at an edge [m]

/// The distance that a point keeps [m], below 0 where it overlaps at rest; none where it lies on
/// another side of the bone, behind the plane of the surface's nearest place. `near`: as for
/// SurfaceDistance.
std::optional<double> rest_clearance(const DistanceField& field, const Vec3& at, int& near) {
  if (field.rough(at) > another_side) return saliva_film;
  const auto foot = field.exact().face().foot(at, near);
  if ((at - foot.place).dot(foot.normal.normalized()) <
      -(foot.on_rim ? field_error : deepest_overlap))
    return std::nullopt;
  double distance = field.exact().from(foot, at, near);
  if (distance < field_error) distance = field.value(at);
  return std::min(saliva_film, distance);
}

/// Cells between points along a face: a power of 2.
int cells(const Vec3& side, const Vec3& opposite, double apart) {
  const double length = std::max(side.norm(), opposite.norm());
  return 1 << std::clamp(int(std::lround(std::log2(length / apart))), 0, 6);
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
      ContactPoint point{{(1 - u) * (1 - v), u * (1 - v), u * v, (1 - u) * v}, 0, saliva_film};
      const auto& w = point.weight;
      const Vec3 by_u = (1 - v) * (x[1] - x[0]) + v * (x[2] - x[3]);
      const Vec3 by_v = (1 - u) * (x[3] - x[0]) + u * (x[2] - x[1]);
      // Trapezoidal rule.
      const double part = (u > 0 && u < 1 ? 1 : 0.5) * (v > 0 && v < 1 ? 1 : 0.5);
      const auto clearance =
          rest_clearance(field, w[0] * x[0] + w[1] * x[1] + w[2] * x[2] + w[3] * x[3], near);
      if (clearance && std::inner_product(w.begin(), w.end(), moves.begin(), 0.0) >= 0.5)
        point.area = part * by_u.cross(by_v).norm() / (face.cells_u * face.cells_v),
        point.clearance = *clearance;
      face.points.push_back(point);
    }
  return face;
}

/// A bilinear piece lies in the sphere about its corners.
struct Sphere {
  Vec3 centre;
  double radius;

  explicit Sphere(const std::array<Vec3, 4>& corners)
      : centre(0.25 * (corners[0] + corners[1] + corners[2] + corners[3])) {
    double squared = 0;
    for (const Vec3& c : corners) squared = std::max(squared, (c - centre).squaredNorm());
    radius = std::sqrt(squared);
  }
};

/// Looks for the points of one face that touch: pieces that lie clear of the bone are left out.
class TouchSearch {
 public:
  TouchSearch(const PlacedSurface& placed, const ContactFace& face, const Positions& x,
              std::vector<TouchingPoint>& out)
      : placed_(placed), face_(face), out_(out) {
    for (size_t a = 0; a < 4; ++a) corner_[a] = node_position(x, face.nodes[a]);
  }
  void run() { look_at({corner_, 0, 0, face_.cells_u, face_.cells_v}); }

 private:
  struct Piece {
    std::array<Vec3, 4> corner;
    int u, v, cells_u, cells_v;  ///< first cell, and how many
  };

  bool clear(const Piece& piece) const {
    const Sphere all(piece.corner);
    return placed_.at_least(all.centre, all.radius) > saliva_film;
  }

  void look_at(const Piece& p) {
    if (clear(p)) return;
    const auto& c = p.corner;
    const int half_u = p.cells_u / 2, half_v = p.cells_v / 2;
    if (p.cells_u > 2 && p.cells_u >= p.cells_v) {
      const Vec3 low = 0.5 * (c[0] + c[1]), high = 0.5 * (c[3] + c[2]);
      look_at({{c[0], low, high, c[3]}, p.u, p.v, half_u, p.cells_v});
      look_at({{low, c[1], c[2], high}, p.u + half_u, p.v, half_u, p.cells_v});
    } else if (p.cells_v > 2) {
      const Vec3 left = 0.5 * (c[0] + c[3]), right = 0.5 * (c[1] + c[2]);
      look_at({{c[0], c[1], right, left}, p.u, p.v, p.cells_u, half_v});
      look_at({{left, right, c[2], c[3]}, p.u, p.v + half_v, p.cells_u, half_v});
    } else {
      // Points between two pieces belong to the first.
      for (int j = p.v + (p.v > 0); j <= p.v + p.cells_v; ++j)
        for (int i = p.u + (p.u > 0); i <= p.u + p.cells_u; ++i)
          ask(face_.points[size_t(j * (face_.cells_u + 1) + i)]);
    }
  }

  void ask(const ContactPoint& point) {
    if (point.area == 0) return;
    const auto& w = point.weight;
    const Vec3 at = w[0] * corner_[0] + w[1] * corner_[1] + w[2] * corner_[2] + w[3] * corner_[3];
    const double depth = point.clearance - placed_.value_if_touching(at);
    if (depth > 0) out_.push_back({&point, at, depth});
  }

  const PlacedSurface& placed_;
  const ContactFace& face_;
  std::vector<TouchingPoint>& out_;
  std::array<Vec3, 4> corner_;
};

/// A search and what it was made for.
struct Search {
  uint64_t surface = 0;
  std::vector<double> jaw;
  Positions x;
  std::vector<TouchingFace> found;
};

std::atomic<uint64_t> surfaces_made = 0;

}  // namespace

ContactSurface contact_surface(std::shared_ptr<const DistanceField> field, const HexMesh& mesh,
                               const std::vector<Support>& supports, std::optional<Vec3> jaw_hinge,
                               double apart) {
  ContactSurface surface{std::move(field), {}, {}, ++surfaces_made, std::move(jaw_hinge)};
  for (const Quad& nodes : outer_faces(mesh, supports)) {
    ContactFace face = contact_face(*surface.field, mesh, nodes, supports, apart);
    if (std::all_of(face.points.begin(), face.points.end(),
                    [](const ContactPoint& p) { return p.area == 0; }))
      continue;
    surface.nodes.insert(surface.nodes.end(), nodes.begin(), nodes.end());
    surface.faces.push_back(std::move(face));
  }
  std::sort(surface.nodes.begin(), surface.nodes.end());
  surface.nodes.erase(std::unique(surface.nodes.begin(), surface.nodes.end()), surface.nodes.end());
  return surface;
}

std::vector<ParameterName> ContactSurface::borrows() const {
  if (!jaw_hinge) return {};
  return {{"jaw_opening", "angle"}, {"jaw_opening", "slide"}};
}

PlacedSurface::PlacedSurface(const ContactSurface& surface, EffectParameters jaw)
    : field_(*surface.field) {
  if (!surface.jaw_hinge) return;
  jaw_ = JawMotion{*surface.jaw_hinge, jaw[0], jaw[1]};
  moved_ = jaw_.angle != 0 || jaw_.slide != 0;
  turn_ = jaw_.turn();
}

DistanceSample PlacedSurface::sample(const Vec3& x) const {
  if (!moved_) return field_.sample(x);
  DistanceSample s = field_.sample(jaw_.back(x));
  s.gradient = turn_ * s.gradient;
  s.hessian = turn_ * s.hessian * turn_.transpose();
  return s;
}

std::pair<double, Vec3> PlacedSurface::by_jaw(const Vec3& x, bool angle) const {
  const DistanceSample s = field_.sample(jaw_.back(x));
  const Vec3 local = angle ? jaw_.back_by_angle(x) : jaw_.back_by_slide();
  Vec3 gradient = turn_ * (s.hessian * local);
  if (angle) gradient += jaw_.turn_by_angle() * s.gradient;
  return {s.gradient.dot(local), gradient};
}

const std::vector<TouchingFace>& find_touching(const ContactSurface& surface, const Positions& x,
                                               EffectParameters jaw) {
  thread_local std::array<Search, 4> latest;  // palate and jaw, each at two shapes
  thread_local size_t oldest = 0;
  for (const Search& s : latest)
    if (s.surface == surface.identity && std::ranges::equal(s.jaw, jaw) && s.x == x) return s.found;
  Search& s = latest[oldest];
  oldest = (oldest + 1) % latest.size();
  s.surface = surface.identity, s.jaw.assign(jaw.begin(), jaw.end()), s.x = x;
  s.found.clear();
  const PlacedSurface placed(surface, jaw);
  std::vector<TouchingPoint> touching;
  for (const ContactFace& face : surface.faces) {
    TouchSearch(placed, face, x, touching).run();
    if (!touching.empty()) s.found.push_back({&face, std::exchange(touching, {})});
  }
  return s.found;
}

void FaceStiffness::add(const ContactPoint& point, const Mat3& k) {
  for (size_t a = 0, at = 0; a < 4; ++a)
    for (size_t b = 0; b <= a; ++b, ++at) pair_[at] += point.weight[a] * point.weight[b] * k;
}

void FaceStiffness::add_to(const Quad& nodes, Stiffness& k) const {
  for (size_t a = 0, at = 0; a < 4; ++a)
    for (size_t b = 0; b <= a; ++b, ++at) k.add(nodes[a], nodes[b], pair_[at]);
}

}  // namespace genio
