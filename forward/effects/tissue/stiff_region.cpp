#include "forward/effects/tissue/stiff_region.hpp"

#include "forward/effects/places.hpp"
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

/// Of the centre: it is absent nowhere.
ParameterInfo coordinate(const char* name, double value) {
  return {.name = name, .unit = "m", .value = value, .lower = -1, .upper = 1, .absent = value};
}

Vec3 centroid(const HexMesh& mesh) {
  Vec3 sum = Vec3::Zero();
  for (const Vec3& x : mesh.nodes) sum += x;
  return sum / double(mesh.nodes.size());
}

/// A ball below the dorsum or at a side of it, stiffer or softer.
EffectChange hidden_region(const ChangeDraw& draw) {
  std::mt19937& random = draw.random;
  std::uniform_real_distribution<double> uniform(-1, 1);
  const Vec3 top = drawn_on_dorsum(draw.tongue, random);
  Vec3 at = top + Vec3(0, 0, -0.008 - 0.004 * (1 + uniform(random)));
  const double side = uniform(random);
  at[1] = std::abs(side) < 0.4 ? 0 : 0.012 * (side > 0 ? 1 : -1);
  const double radius = 0.016 + 0.003 * uniform(random);
  const bool softer = random() % 2;
  EffectChange change = change_by_table(
      "stiff_region",
      [=](double s) {
        return EffectTable{{"factor", softer ? std::max(0.05, 1 / (1 + s)) : 1 + s},
                           {"x", at[0]},
                           {"y", at[1]},
                           {"z", at[2]},
                           {"radius", radius}};
      },
      4, 60);
  change.symmetric = at[1] == 0, change.drawn = true;
  return change;
}

}  // namespace

StiffRegion::StiffRegion(const HexMesh& mesh, double factor, const Vec3& centre, double radius,
                         bool nonlinear)
    : TissuePotential(mesh),
      info_{{{.name = "factor",
              .unit = "1",
              .value = factor,
              .lower = 0.05,
              .upper = 100,
              .absent = 1},
             coordinate("x", centre[0]),
             coordinate("y", centre[1]),
             coordinate("z", centre[2]),
             {.name = "radius",
              .unit = "m",
              .value = radius,
              .lower = 1e-3,
              .upper = 1,
              .absent = radius}}} {
  if (nonlinear)
    for (const char* key : {"a20", "a30"}) borrows_.push_back({"material_nonlinearity", key});
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

EffectKind stiff_region_kind() {
  return {.name = "stiff_region",
          .make = [](Settings& s, const Anatomy& a) -> Effect {
            const double factor = s.take("factor", 1), radius = s.take("radius", 0.015);
            return {.potential = std::make_shared<StiffRegion>(
                        a.description.mesh, factor, s.take_point("", centroid(a.description.mesh)),
                        radius, a.description.effects.contains("material_nonlinearity"))};
          },
          .belief = {.parameters = {{.parameter = "factor", .typical = 1.5, .ratio = true},
                                    {.parameter = "x", .typical = 0.01, .detail = true},
                                    {.parameter = "y", .typical = 0.01, .detail = true},
                                    {.parameter = "z", .typical = 0.01, .detail = true},
                                    {.parameter = "radius", .typical = 4e-3, .detail = true}}},
          .places = regions,
          .sample = {{"factor", 3}, {"x", 0.006}, {"y", 0.004}, {"z", 0.006}, {"radius", 0.007}},
          .hidden = hidden_region};
}

}  // namespace genio
