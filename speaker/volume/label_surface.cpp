#include "speaker/volume/label_surface.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "speaker/isosurface/isosurface.hpp"
#include "speaker/solid/surface_figures.hpp"

namespace genio {
namespace {

// exp(-n^2 / (2 0.7^2)), their sum made 1.
constexpr float blur[3] = {0.56991f, 0.20542f, 0.00962f};

constexpr double slope = 0.57;  // of a blurred step at its middle [1 / voxel]
constexpr double lowest = 0.35;

class BlurredLabel {
 public:
  explicit BlurredLabel(const LabelledBox& box)
      : box_(box), nu_(size_t(box.size[0])), nv_(size_t(box.size[1])), sum_(nu_ * nv_) {}

  void layer(int k, float level, std::span<float> out) {
    std::fill(sum_.begin(), sum_.end(), 0.f);
    for (int d = -2; d <= 2; ++d) {
      if (k + d < 0 || k + d >= box_.size[2]) continue;
      const std::uint8_t* from = &box_.is[size_t(k + d) * nu_ * nv_];
      for (size_t i = 0; i < sum_.size(); ++i) sum_[i] += weight(d) * from[i];
    }
    along(sum_, 1, nu_, nv_, nu_, rows_);
    along(rows_, nu_, nv_, nu_, 1, sum_);
    for (size_t i = 0; i < sum_.size(); ++i) out[i] = level - sum_[i];
  }

 private:
  static float weight(int d) { return blur[d < 0 ? -d : d]; }

  /// Blurs lines of `count` values that stand `step` apart.
  static void along(const std::vector<float>& from, size_t step, size_t count, size_t lines,
                    size_t between, std::vector<float>& to) {
    to.assign(from.size(), 0.f);
    for (size_t l = 0; l < lines; ++l)
      for (size_t i = 0; i < count; ++i)
        for (int d = -2; d <= 2; ++d) {
          const auto other = std::ptrdiff_t(i) + d;
          if (other >= 0 && other < std::ptrdiff_t(count))
            to[l * between + i * step] += weight(d) * from[l * between + size_t(other) * step];
        }
  }

  const LabelledBox& box_;
  size_t nu_, nv_;
  std::vector<float> sum_, rows_;
};

}  // namespace

TriangleSurface label_surface(const LabelledBox& box) {
  BlurredLabel blurred(box);
  LayeredField field;
  for (size_t d = 0; d < 3; ++d) {
    field.axis[d].resize(size_t(box.size[d]));
    std::iota(field.axis[d].begin(), field.axis[d].end(), 0.0);
  }
  const auto at_level = [&](double level) {
    field.layer = [&](int k, std::span<float> values) { blurred.layer(k, float(level), values); };
    return isosurface(field, [&](const Vec3& ijk) { return Vec3(box.to_metres * ijk); });
  };
  const TriangleSurface surface = at_level(0.5);
  if (surface.triangles.empty()) return surface;
  // The blur shrinks what is round: the surface is moved until it holds what the voxels hold.
  const SurfaceFigures f = surface_figures(surface);
  const double voxel = std::abs(box.to_metres.linear().determinant());
  const double way = (voxel * double(box.voxels) - f.volume) / f.area / std::cbrt(voxel);
  return at_level(std::clamp(0.5 - slope * way, lowest, 0.5));
}

}  // namespace genio
