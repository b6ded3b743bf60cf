#include "speaker/decimation/distance_guard.hpp"

#include <cmath>
#include <limits>

namespace genio {
namespace {

constexpr size_t most_samples = 30000;

}  // namespace

DistanceGuard::DistanceGuard(const TriangleSurface& first, const TriangleSurface& present,
                             const DeviationScale& scale)
    : distance_(first), scale_(scale), samples_(present.triangles.size()) {
  const SurfaceDistance to_present(present);
  const size_t every = (first.vertices.size() + first.triangles.size()) / most_samples + 1;
  int near = -1;
  const auto take = [&](const Vec3& p) {
    to_present(p, near);
    samples_[size_t(near)].push_back(int(sample_.size()));
    sample_.push_back(p);
    sample_scale_.push_back(scale.at(p));
  };
  for (size_t v = 0; v < first.vertices.size(); v += every) take(first.vertices[v]);
  for (size_t t = 0; t < first.triangles.size(); t += every) {
    const auto& n = first.triangles[t];
    take((first.vertices[size_t(n[0])] + first.vertices[size_t(n[1])] +
          first.vertices[size_t(n[2])]) /
         3);
  }
}

double DistanceGuard::deviation(const CollapsingMesh& mesh, int a, int b, const Vec3& at,
                                double most) {
  struct NewTriangle {
    int number;
    Vec3 corner[3];
  };
  std::vector<NewTriangle> fan;
  homes_.clear(), left_.clear();
  int near = -1;
  double largest = 0;
  const auto look_at = [&](const Vec3& p) {
    largest = std::max(largest, scale_.at(p) * std::abs(distance_(p, near)));
    return largest <= most;
  };
  if (!look_at(at)) return largest;
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
    const Vec3 middle = (c[0] + c[1] + c[2]) / 3;
    if (!look_at(middle)) return largest;
    for (int i = 0; i < 3; ++i) {
      if (!look_at(0.5 * (middle + c[i]))) return largest;
      const int v = mesh.corners(t)[size_t(i)];
      if (v != a && v != b) continue;  // the side that follows starts at `at`; the next fan has it
      for (const double part : {0.25, 0.5, 0.75})
        if (!look_at(at + part * (c[(i + 1) % 3] - at))) return largest;
    }
    fan.push_back(made);
  }
  for (const auto& [t, stays] : affected)
    for (const int sample : samples_[size_t(t)]) {
      const Vec3& p = sample_[size_t(sample)];
      double least = std::numeric_limits<double>::infinity();
      int home = -1;
      for (const NewTriangle& made : fan) {
        const auto& c = made.corner;
        const auto w = closest_on_triangle(p, c[0], c[1], c[2]);
        const double d = (p - w[0] * c[0] - w[1] * c[1] - w[2] * c[2]).squaredNorm();
        if (d < least) least = d, home = made.number;
      }
      homes_.push_back({sample, home});
      largest = std::max(largest, sample_scale_[size_t(sample)] * std::sqrt(least));
      if (largest > most) return largest;
    }
  return largest;
}

void DistanceGuard::done() {
  for (const int t : left_) samples_[size_t(t)].clear();
  for (const Home& home : homes_) samples_[size_t(home.triangle)].push_back(home.sample);
}

}  // namespace genio
