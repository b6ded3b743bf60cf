#include "report/pictures/shape_picture.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>

#include "forward/model/at_anatomy.hpp"
#include "report/pictures/svg.hpp"

namespace genio {
namespace {

Axes framed(Svg& svg, Axes axes, const std::string& below) {
  svg.rect(axes.left, axes.top, axes.width, axes.height, {"#ccc"});
  for (double z = 60; z <= 120; z += 20) {
    svg.line(axes.left, axes.py(z), axes.left + axes.width, axes.py(z), {"#eee"});
    svg.text(axes.left - 6, axes.py(z) + 4, fmt::format("{}", z), 11, "end", "#777");
  }
  svg.text(axes.left + axes.width / 2, axes.top + axes.height + 20, below, 12, "middle", "#555");
  return axes;
}

/// Faces of the surface that look forwards, seen from there.
void draw_front(Svg& svg, const Axes& axes, const Model& m, const Positions& x,
                const Style& style) {
  for (const Quad& face : m.surface) {
    const Vec3 normal = Vec3(node_position(x, face[2]) - node_position(x, face[0]))
                            .cross(Vec3(node_position(x, face[3]) - node_position(x, face[1])));
    if (normal[0] > 0) continue;
    std::vector<Eigen::Vector2d> outline;
    for (int i = 0; i < 5; ++i) {
      const Vec3 p = 1e3 * node_position(x, face[size_t(i % 4)]);
      outline.emplace_back(p[1], p[2]);
    }
    svg.polyline(axes, outline, style);
  }
}

/// The surface in the midsagittal plane as contact knows it: straight from node to node. The smooth
/// line through the same nodes bulges beyond them where a bone bends the surface sharply.
std::vector<Eigen::Vector2d> surface_line(const Model& m, const Positions& x) {
  std::vector<Eigen::Vector2d> line;
  for (const int n : m.midsagittal) line.emplace_back(x[3 * n], x[3 * n + 2]);
  return line;
}

}  // namespace

std::string draw_shape(const Model& given, const Positions& x, const std::string& title) {
  const auto here = at_anatomy(given);
  const Model& m = *here;
  Svg svg(1060, 520);
  svg.text(50, 28, title, 16, "start", "#111");
  const Axes side = framed(svg, {38, 148, 44, 134, 50, 44, 530, 434}, "x [mm], lips left");
  for (const auto* surface : {&m.palate, &m.jaw, &m.hyoid})
    if (*surface)
      for (const auto& cut : midsagittal_cut(**surface))
        svg.polyline(side, in_mm(cut), {bone, "none", 2});
  svg.polyline(side, in_mm(surface_line(m, m.rest)), {grey, "none", 2.4});
  svg.polyline(side, in_mm(surface_line(m, x)), {blue, "none", 2.6});
  const Axes front = framed(svg, {-45, 45, 44, 134, 616, 44, 434, 434}, "y [mm], from the front");
  draw_front(svg, front, m, m.rest, {"#c9cdd1", "none", 1});
  draw_front(svg, front, m, x, {blue, "none", 1});
  return svg.str();
}

}  // namespace genio
