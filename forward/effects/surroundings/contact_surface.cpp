#include "forward/effects/surroundings/contact_surface.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <utility>

namespace genio {
namespace {

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
      : placed_(placed), face_(face), out_(out), corner_(corners(x, face.nodes)) {}
  void run() { look_at({corner_, 0, 0, face_.cells_u, face_.cells_v}); }

 private:
  struct Piece {
    std::array<Vec3, 4> corner;
    int u, v, cells_u, cells_v;  ///< first cell, and how many
  };

  bool clear(const Piece& piece) const {
    const Sphere all(piece.corner);
    return placed_.at_least(all.centre, all.radius) > contact_gap;
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
          ask(face_.points[size_t(j) * size_t(face_.cells_u + 1) + size_t(i)]);
    }
  }

  void ask(const ContactPoint& point) {
    if (point.area == 0) return;
    const Vec3 at = blend(corner_, point.weight);
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
  ContactSurface surface;
  std::vector<double> jaw;
  Positions x;
  std::vector<TouchingFace> found;

  bool is_of(const ContactSurface& s, const Positions& at, EffectParameters p) const {
    return surface.touchable == s.touchable && surface.jaw_hinge == s.jaw_hinge &&
           std::ranges::equal(jaw, p) && x == at;
  }
};

}  // namespace

std::vector<ParameterName> ContactSurface::borrows() const {
  if (!jaw_hinge) return {};
  return {{"jaw_opening", "angle"}, {"jaw_opening", "slide"}};
}

PlacedSurface::PlacedSurface(const ContactSurface& surface, EffectParameters jaw)
    : field_(*surface.touchable->field) {
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

DistanceRates::Rates PlacedSurface::rates(DistanceRates& rates, const Vec3& x) const {
  DistanceRates::Rates r = rates.at(local(x));
  r.gradient = turn_ * r.gradient;
  return r;
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
    if (s.is_of(surface, x, jaw)) return s.found;
  Search& s = latest[oldest];
  oldest = (oldest + 1) % latest.size();
  s.surface = surface, s.jaw.assign(jaw.begin(), jaw.end()), s.x = x;
  s.found.clear();
  const PlacedSurface placed(surface, jaw);
  std::vector<TouchingPoint> touching;
  for (const ContactFace& face : surface.touchable->faces) {
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
