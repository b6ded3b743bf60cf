#include "data/generator/generic_surfaces.hpp"

#include <cmath>
#include <functional>
#include <numbers>

#include "data/generator/outline.hpp"

namespace genio::generic {
namespace {

/// Triangulated sheet of (rows + 1) x (columns + 1) points [mm]; `around` closes the columns.
TriangleSurface sheet(int rows, int columns, bool around,
                      const std::function<Vec3(double, double)>& point) {
  TriangleSurface s;
  const int wide = around ? columns : columns + 1;
  for (int r = 0; r <= rows; ++r)
    for (int c = 0; c < wide; ++c)
      s.vertices.push_back(1e-3 * point(double(r) / rows, double(c) / columns));
  for (int r = 0; r < rows; ++r)
    for (int c = 0; c < columns; ++c) {
      const int c1 = around ? (c + 1) % columns : c + 1;
      const int a = r * wide + c, b = r * wide + c1, d = a + wide, e = b + wide;
      if (!around && 2 * c < columns) {  // diagonals mirror each other, left and right
        s.triangles.push_back({a, b, d});
        s.triangles.push_back({b, e, d});
      } else {
        s.triangles.push_back({a, b, e});
        s.triangles.push_back({a, e, d});
      }
    }
  return s;
}

}  // namespace

TriangleSurface make_palate() {
  const Curve line = palate_line();
  return sheet(40, 24, false, [&](double u, double v) {
    const double across = 2 * v - 1;
    const Point2 p = line.at(u);
    const double width = blend({{0.0, 13.0}, {0.12, 22.0}, {0.35, 28.0}, {1.0, 29.5}}, u);
    // How far the sides hang below the vault: deep in the hard palate, flat in the pharynx.
    const double arch =
        blend({{0.0, 3.0}, {0.1, 8.0}, {0.35, 17.0}, {0.55, 15.0}, {0.75, 5.0}, {1.0, 0.0}}, u);
    const double drop = arch * std::pow(std::abs(across), 2.6);
    const double forward = blend({{0.6, 0.0}, {1.0, 6.0}}, u) * across * across;
    return Vec3(p[0] - forward, width * across, p[1] - drop);
  });
}

TriangleSurface make_jaw() {
  const Curve line = jaw_line();
  return sheet(16, 32, false, [&](double u, double v) {
    const double across = 2 * v - 1, a = std::abs(across);
    const Point2 apex = line.at(u);
    const double rear = 118, wide = blend({{0.0, 40.0}, {0.5, 40.0}, {1.0, 32.0}}, u);
    // Front teeth stand in an arch; the body of the mandible runs back more pointedly.
    const double sharp = blend({{0.0, 1.1}, {0.5, 1.4}, {1.0, 2.2}}, u);
    return Vec3(apex[0] + (rear - apex[0]) * std::pow(a, sharp), wide * across,
                apex[1] + blend({{0.0, 5.0}, {1.0, 0.0}}, u) * a * a);
  });
}

TriangleSurface make_hyoid() {
  return sheet(24, 12, true, [](double u, double v) {
    const double bend = (2 * u - 1) * 0.5 * std::numbers::pi, turn = 2 * std::numbers::pi * v;
    const double thick = 0.3 + 3.7 * std::pow(std::cos(bend), 0.5);
    const Vec3 out(-std::cos(bend), std::sin(bend), 0), up(0, 0, 1);
    const Vec3 centre =
        Vec3(127, 0, 53 + 8 * std::pow(std::sin(bend), 2)) + Vec3(13 * out[0], 22 * out[1], 0);
    return Vec3(centre + thick * (std::cos(turn) * out + 1.2 * std::sin(turn) * up));
  });
}

}  // namespace genio::generic
