#include "data/generator/generic_tongue.hpp"

#include <cmath>

#include "data/generator/generic_muscles.hpp"
#include "data/generator/generic_surfaces.hpp"
#include "data/generator/outline.hpp"

namespace genio::generic {
namespace {

/// Position [mm] of the grid point: `u` along the surface line, `depth` from front (0) to surface
/// (1), `across` from the left side (-1) to the right (1).
Vec3 grid_point(const Curve& surface, const Curve& front, double u, double depth, double across) {
  const double side2 = across * across, edge = std::pow(std::abs(across), 3.0);
  const Point2 inner = front.at(u), outer = surface.at(u);
  // Rounded edges: the surface draws back towards the sides, and the outermost layer is narrower.
  const double round =
      blend({{0.0, 0.03}, {0.1, 0.05}, {0.3, 0.13}, {0.6, 0.10}, {0.85, 0.04}, {1.0, 0.0}}, u);
  const double d = depth * (1 - round * edge * depth);
  // The fan's lines leave the front nearly square and bend to their place on the surface.
  const Point2 way = outer - inner;
  const Point2 handle =
      inner + way.norm() * (0.30 * front.left_normal(u) + 0.22 * way.normalized());
  const Point2 p = (1 - d) * (1 - d) * inner + 2 * d * (1 - d) * handle + d * d * outer;
  const double y = across * half_width(u, depth) * (1 - 0.10 * std::pow(depth, 6));
  // The floor hangs like a hammock between the mylohyoid lines; the front hugs the chin's curve.
  const double hammock =
      blend({{0.6, 0.0}, {1.0, 12.0}}, u) * side2 * (0.15 + 3.2 * depth * (1 - depth));
  return {p[0] + 1.5 * side2 * (1 - depth), y, p[1] + hammock};
}

Support support_at(const Resolution& r, int i, int j, int k) {
  const double u = double(i) / r.along, depth = double(j) / r.deep;
  const double across = std::abs(double(k)) / r.across;
  if (j == 0 && u > 0.12) return Support::fixed;                         // mental symphysis
  if (across == 1.0 && u > 0.85 && depth < 0.75) return Support::fixed;  // mylohyoid line
  if (across == 1.0 && u > 0.75 && depth < 0.2) return Support::fixed;
  if (across > 0.5 && u > 0.95 && depth < 0.2) return Support::fixed;  // front of the floor
  if (across > 0.7 && u > 0.95 && depth < 0.4) return Support::fixed;
  if (u > 0.90 && j == r.deep) return Support::horizontal;  // hyoid
  return Support::free;
}

}  // namespace

ModelDescription make_generic_tongue(const Resolution& r) {
  ModelDescription d;
  d.name = "Generic tongue";
  d.provenance = "made by genio-make-generic from published dimensions; see docs/generic.md";
  const Curve surface = surface_line(), front = front_line();
  const int wide = 2 * r.across + 1;
  const NodeAt node = [&](int i, int j, int k) {
    return (i * (r.deep + 1) + j) * wide + k + r.across;
  };
  for (int i = 0; i <= r.along; ++i)
    for (int j = 0; j <= r.deep; ++j)
      for (int k = -r.across; k <= r.across; ++k) {
        d.mesh.nodes.push_back(1e-3 * grid_point(surface, front, double(i) / r.along,
                                                 double(j) / r.deep, double(k) / r.across));
        d.supports.push_back(support_at(r, i, j, k));
      }
  for (int i = 0; i < r.along; ++i)
    for (int j = 0; j < r.deep; ++j)
      for (int k = -r.across; k < r.across; ++k)
        d.mesh.elements.push_back({node(i, j, k), node(i, j + 1, k), node(i + 1, j + 1, k),
                                   node(i + 1, j, k), node(i, j, k + 1), node(i, j + 1, k + 1),
                                   node(i + 1, j + 1, k + 1), node(i + 1, j, k + 1)});
  d.muscles = make_muscles(r, node, d.mesh);
  for (int j = 1; j < r.deep; ++j) d.midsagittal.push_back(node(0, j, 0));
  for (int i = 0; i <= r.along && d.supports[node(i, r.deep, 0)] == Support::free; ++i)
    d.midsagittal.push_back(node(i, r.deep, 0));
  const auto nearest = [&](double x, double z) {
    int best = d.midsagittal.front();
    for (int a : d.midsagittal)
      if ((d.mesh.nodes[a] - 1e-3 * Vec3(x, 0, z)).norm() <
          (d.mesh.nodes[best] - 1e-3 * Vec3(x, 0, z)).norm())
        best = a;
    return best;
  };
  d.landmarks = {nearest(57.6, 99.9), nearest(94.8, 113.7), nearest(127.4, 88.1)};
  d.palate = make_palate();
  d.jaw = make_jaw();
  d.hyoid = make_hyoid();
  d.effects["elasticity"] = {{"a10", 1037}, {"a20", 486}, {"kappa", 1037000}};
  d.effects["palate_contact"] = {{"stiffness", 2e8}, {"damping", 5}};
  d.effects["jaw_contact"] = {{"stiffness", 2e8}, {"damping", 5}};
  d.effects["viscosity"] = {{"alpha", 40}, {"beta", 0.03}};
  return d;
}

}  // namespace genio::generic
