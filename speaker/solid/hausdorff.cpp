#include "speaker/solid/hausdorff.hpp"

#include <algorithm>
#include <limits>
#include <queue>

namespace genio {
namespace {

constexpr size_t most_pieces = 4000000;  // split in all; the tolerance stops far earlier

/// A place on the first surface and the triangle of the second that is nearest.
struct Probe {
  Vec3 at;
  double distance;
  int nearest;
};

struct SurfacePiece {
  std::array<Probe, 3> corner;
  double bound;  ///< no place is farther than this [m]
  bool operator<(const SurfacePiece& other) const { return bound < other.bound; }
};

class FarthestSearch {
 public:
  FarthestSearch(const TriangleSurface& to_surface, const SurfaceDistance& to,
                 const KeptRegion* within)
      : surface_(to_surface), to_(to), within_(within) {}

  double operator()(const TriangleSurface& from, double tolerance) {
    std::priority_queue<SurfacePiece> waiting;
    int near = -1;
    const auto keep = [&](const std::array<Probe, 3>& corner) {
      const SurfacePiece piece{corner, bound(corner)};
      if (piece.bound > best_ + tolerance) waiting.push(piece);
    };
    for (const auto& t : from.triangles) {
      std::array<Probe, 3> corner;
      for (size_t i = 0; i < 3; ++i) corner[i] = probe(from.vertices[size_t(t[i])], near);
      keep(corner);
    }
    for (size_t count = 0; !waiting.empty() && count < most_pieces; ++count) {
      const SurfacePiece piece = waiting.top();
      waiting.pop();
      if (piece.bound <= best_ + tolerance) break;
      const auto& c = piece.corner;
      std::array<Probe, 3> middle;
      for (size_t i = 0; i < 3; ++i)
        middle[i] = probe(0.5 * (c[i].at + c[(i + 1) % 3].at), c[i].nearest);
      keep({c[0], middle[0], middle[2]});
      keep({middle[0], c[1], middle[1]});
      keep({middle[2], middle[1], c[2]});
      keep(middle);
    }
    return best_;
  }

 private:
  Probe probe(const Vec3& at, int near) {
    const double distance = std::abs(to_(at, near));
    if (!within_ || within_->holds(at)) best_ = std::max(best_, distance);
    return {at, distance, near};
  }

  double bound(const std::array<Probe, 3>& corner) {
    const Vec3 middle = (corner[0].at + corner[1].at + corner[2].at) / 3;
    double radius = 0;
    for (const Probe& c : corner) radius = std::max(radius, (c.at - middle).norm());
    if (within_ && !within_->reaches(middle, radius)) return 0;
    const Probe centre = probe(middle, corner[0].nearest);
    double least = centre.distance + radius;
    for (const int t : {centre.nearest, corner[0].nearest, corner[1].nearest, corner[2].nearest}) {
      const auto& n = surface_.triangles[size_t(t)];
      const Vec3 &a = surface_.vertices[size_t(n[0])], &b = surface_.vertices[size_t(n[1])],
                 &c = surface_.vertices[size_t(n[2])];
      double most = 0;
      for (const Probe& p : corner) {
        const auto w = closest_on_triangle(p.at, a, b, c);
        most = std::max(most, (p.at - w[0] * a - w[1] * b - w[2] * c).norm());
        if (most >= least) break;
      }
      least = std::min(least, most);
    }
    return least;
  }

  const TriangleSurface& surface_;
  const SurfaceDistance& to_;
  const KeptRegion* within_;
  double best_ = 0;
};

}  // namespace

double farthest_from(const TriangleSurface& from, const TriangleSurface& to,
                     const SurfaceDistance& distance, double tolerance, const KeptRegion* within) {
  return FarthestSearch(to, distance, within)(from, tolerance);
}

double hausdorff_distance(const TriangleSurface& a, const TriangleSurface& b, double tolerance,
                          const KeptRegion* within) {
  return std::max(farthest_from(a, b, SurfaceDistance(b), tolerance, within),
                  farthest_from(b, a, SurfaceDistance(a), tolerance, within));
}

}  // namespace genio
