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

/// Where a tongue may touch a surface.
struct Box {
  Vec3 low, high;

  Box(const TriangleSurface& surface, const std::vector<Vec3>& nodes)
      : low(nodes[0]), high(nodes[0]) {
    Vec3 s_low = surface.vertices[0], s_high = s_low;
    for (const Vec3& x : nodes) low = low.cwiseMin(x), high = high.cwiseMax(x);
    for (const Vec3& x : surface.vertices) s_low = s_low.cwiseMin(x), s_high = s_high.cwiseMax(x);
    const Vec3 about = Vec3::Constant(reach);
    const double widest = std::max(high[1], -low[1]) + reach;  // also where the bone is far aside
    low = (low - about).cwiseMax(s_low - 0.5 * about);
    high = (high + about).cwiseMin(s_high + 0.5 * about);
    high = high.cwiseMax(low + Vec3::Constant(4 * spacing));
    // The same samples left and right, and for a tongue and for its half.
    high[1] = spacing * std::ceil(std::min(std::max(high[1], -low[1]), widest) / spacing);
    low[1] = -high[1];
  }
  bool operator==(const Box& other) const { return low == other.low && high == other.high; }
};

/// A field and what it is made of.
struct Kept {
  TriangleSurface surface;
  Box box;
  std::shared_ptr<const DistanceField> field;
};

}  // namespace

std::shared_ptr<const DistanceField> bone_field(const TriangleSurface& surface,
                                                const HexMesh& mesh) {
  static std::mutex mutex;
  static std::deque<Kept> kept;
  const TriangleSurface facing = facing_tongue(surface, mesh.nodes);
  const Box box(facing, mesh.nodes);
  {
    const std::lock_guard lock(mutex);
    for (const Kept& k : kept)
      if (k.box == box && k.surface.vertices == facing.vertices &&
          k.surface.triangles == facing.triangles)
        return k.field;
  }
  auto field = std::make_shared<DistanceField>(facing, box.low, box.high, spacing);
  const std::lock_guard lock(mutex);
  kept.push_back({facing, box, field});
  if (kept.size() > most_kept) kept.pop_front();
  return field;
}

std::shared_ptr<const DistanceField> moved_bone_field(const DistanceField& standing,
                                                      const TriangleSurface& surface,
                                                      const HexMesh& mesh) {
  const TriangleSurface facing = facing_tongue(surface, mesh.nodes);
  const Box box(facing, mesh.nodes);
  const Vec3 cells = (box.low - standing.low()) / spacing;
  return std::make_shared<DistanceField>(
      facing, standing.low() + spacing * Vec3(cells.array().floor()), box.high, spacing);
}

}  // namespace genio
