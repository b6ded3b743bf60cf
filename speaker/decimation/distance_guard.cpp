#include "speaker/decimation/distance_guard.hpp"

#include <limits>

namespace genio {

DistanceGuard::DistanceGuard(const TriangleSurface& first, const DistanceBounds& bounds)
    : first_(first), distance_(first), bounds_(bounds), samples_(first.triangles.size()) {
  std::vector<bool> placed(first.vertices.size(), false);
  for (size_t t = 0; t < first.triangles.size(); ++t)
    for (const int v : first.triangles[t])
      if (!placed[size_t(v)]) {
        placed[size_t(v)] = true;
        samples_[t].push_back(v);
      }
  for (const Vec3& v : first.vertices) bound_.push_back(bounds.at(v));
}

bool DistanceGuard::allows(const CollapsingMesh& mesh, int a, int b, const Vec3& at) {
  struct NewTriangle {
    int number;
    Vec3 corner[3];
  };
  std::vector<NewTriangle> fan;
  homes_.clear(), left_.clear();
  int near = -1;
  const auto far = [&](const Vec3& p) { return std::abs(distance_(p, near)) > bounds_.at(p); };
  if (far(at)) return false;
  const auto affected = mesh.affected(a, b);
  for (const auto& [t, stays] : affected) {
    left_.push_back(t);
    if (!stays) continue;
    NewTriangle made{t, {}};
    for (size_t i = 0; i < 3; ++i) {
      const int v = mesh.corners(t)[i];
      made.corner[i] = v == a || v == b ? at : mesh.place(v);
    }
    const auto& c = made.corner;
    if (far((c[0] + c[1] + c[2]) / 3)) return false;
    for (int i = 0; i < 3; ++i)
      if (far(0.5 * (c[i] + c[(i + 1) % 3]))) return false;
    fan.push_back(made);
  }
  for (const auto& [t, stays] : affected)
    for (const int sample : samples_[size_t(t)]) {
      const Vec3& p = first_.vertices[size_t(sample)];
      double least = std::numeric_limits<double>::infinity();
      int home = -1;
      for (const NewTriangle& made : fan) {
        const auto& c = made.corner;
        const auto w = closest_on_triangle(p, c[0], c[1], c[2]);
        const double d = (p - w[0] * c[0] - w[1] * c[1] - w[2] * c[2]).squaredNorm();
        if (d < least) least = d, home = made.number;
      }
      const double bound = bound_[size_t(sample)];
      if (least > bound * bound) return false;
      homes_.push_back({sample, home});
    }
  return true;
}

void DistanceGuard::done() {
  for (const int t : left_) samples_[size_t(t)].clear();
  for (const Home& home : homes_) samples_[size_t(home.triangle)].push_back(home.sample);
}

}  // namespace genio
