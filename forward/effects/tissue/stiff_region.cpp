#include "forward/effects/tissue/stiff_region.hpp"

#include "forward/tissue/fibre_field.hpp"

namespace genio {
namespace {

/// Of the tissue that is scaled [Pa].
struct Own {
  double a10 = 0, a20 = 0, a30 = 0;
};

Own own(EffectParameters p) {
  Own o{p[5], p[6], 0};
  if (p.size() > 7) o.a20 += p[7], o.a30 = p[8];
  return o;
}

/// It, scaled by what `scale` says of each Gauss point.
template <class Points, class Scale>
BatchTissue scaled(const Points& points, const Own& own, Scale scale) {
  BatchTissue t;
  t.kappa = lanes::splat(0);
  for (int q = 0; q < 8; ++q) {
    lanes::Lane s;
    for (int l = 0; l < lanes::width; ++l) s[l] = scale(points[q][l]);
    t.law[q] = {own.a10 * s, own.a20 * s, own.a30 * s};
  }
  return t;
}

}  // namespace

StiffRegion::StiffRegion(const HexMesh& mesh, double factor, const Vec3& centre, double radius,
                         bool nonlinear)
    : TissueEffect(mesh),
      info_{{{"factor", "1", factor, 0.05, 100, 1, false, false, 1.5},
             {"x", "m", centre[0], -1, 1, centre[0], false, false, 0.01, true},
             {"y", "m", centre[1], -1, 1, centre[1], false, false, 0.01, true},
             {"z", "m", centre[2], -1, 1, centre[2], false, false, 0.01, true},
             {"radius", "m", radius, 1e-3, 1, radius, false, false, 4e-3, true}}} {
  info_[0].ratio = true;
  if (nonlinear)
    for (const char* name : {"a20", "a30"})
      borrows_.push_back(std::string("material_nonlinearity.") + name);
  for (const ElementBatch& batch : batches_) {
    auto& points = points_.emplace_back();
    for (int q = 0; q < 8; ++q)
      for (int l = 0; l < lanes::width; ++l) points[q][l] = gauss_point(mesh, batch.element[l], q);
  }
}

BatchTissue StiffRegion::tissue(size_t b, EffectParameters p) const {
  const Vec3 centre(p[1], p[2], p[3]);
  return scaled(points_[b], own(p), [&](const Vec3& x) {
    const double inside = 1 - (x - centre).squaredNorm() / (p[4] * p[4]);
    return inside > 0 ? (p[0] - 1) * inside * inside * inside : 0.0;
  });
}

BatchTissue StiffRegion::tissue_derivative(size_t b, EffectParameters p, int k) const {
  const Vec3 centre(p[1], p[2], p[3]);
  const double r2 = p[4] * p[4];
  const Vec3 axis = k >= 1 && k <= 3 ? Vec3(Vec3::Unit(k - 1)) : Vec3(Vec3::Zero());
  const auto scale = [&](const Vec3& x) {
    const Vec3 d = x - centre;
    const double inside = 1 - d.squaredNorm() / r2;
    if (inside <= 0) return 0.0;
    const double slope = (p[0] - 1) * 3 * inside * inside;  // by `inside`
    switch (k) {
      case 0:
        return inside * inside * inside;
      case 4:
        return slope * 2 * d.squaredNorm() / (r2 * p[4]);
      case 5:
      case 6:
      case 7:
      case 8:
        return (p[0] - 1) * inside * inside * inside;
      default:
        return slope * 2 * axis.dot(d) / r2;
    }
  };
  if (k < 5) return scaled(points_[b], own(p), scale);
  return scaled(points_[b], Own{double(k == 5), double(k == 6 || k == 7), double(k == 8)}, scale);
}

}  // namespace genio
