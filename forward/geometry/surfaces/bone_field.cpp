#include "forward/geometry/surfaces/bone_field.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <mutex>

namespace genio {
namespace {

constexpr double spacing = 2e-3;  // [m]
constexpr double reach = 0.02;    // how far from its rest shape the tongue can touch [m]
constexpr size_t most_kept = 32;

/// A field and what it is made of.
struct Kept {
  TriangleSurface surface;
  std::vector<Vec3> nodes;
  std::shared_ptr<const DistanceField> field;
};

std::shared_ptr<const DistanceField> made(const TriangleSurface& surface,
                                          const std::vector<Vec3>& nodes) {
  const TriangleSurface face = facing_tongue(surface, nodes);
  Vec3 low = nodes[0], high = low, s_low = face.vertices[0], s_high = s_low;
  for (const Vec3& x : nodes) low = low.cwiseMin(x), high = high.cwiseMax(x);
  for (const Vec3& x : face.vertices) s_low = s_low.cwiseMin(x), s_high = s_high.cwiseMax(x);
  const Vec3 about = Vec3::Constant(reach);
  const double widest = std::max(high[1], -low[1]) + reach;  // also where the bone is far aside
  low = (low - about).cwiseMax(s_low - 0.5 * about);
  high = (high + about).cwiseMin(s_high + 0.5 * about);
  high = high.cwiseMax(low + Vec3::Constant(4 * spacing));
  // The same samples left and right, and for a tongue and for its half.
  high[1] = spacing * std::ceil(std::min(std::max(high[1], -low[1]), widest) / spacing);
  low[1] = -high[1];
  return std::make_shared<DistanceField>(face, low, high, spacing);
}

}  // namespace

std::shared_ptr<const DistanceField> bone_field(const TriangleSurface& surface,
                                                const HexMesh& mesh) {
  static std::mutex mutex;
  static std::deque<Kept> kept;
  {
    const std::lock_guard lock(mutex);
    for (const Kept& k : kept)
      if (k.surface.vertices == surface.vertices && k.surface.triangles == surface.triangles &&
          k.nodes == mesh.nodes)
        return k.field;
  }
  auto field = made(surface, mesh.nodes);
  const std::lock_guard lock(mutex);
  kept.push_back({surface, mesh.nodes, field});
  if (kept.size() > most_kept) kept.pop_front();
  return field;
}

}  // namespace genio
