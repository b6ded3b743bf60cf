#include "report/pictures/shape_picture.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "forward/model/at_anatomy.hpp"
#include "report/pictures/svg.hpp"

namespace genio {
namespace {

Axes framed(Svg& svg, Axes axes, const std::string& below) {
  svg.rect(axes.left, axes.top, axes.width, axes.height, {"#ccc"});
  const int step = axes.y1 - axes.y0 < 150 ? 20 : 50;  // [mm]
  for (int z = step * int(std::ceil((axes.y0 + 4) / step)); z < axes.y1 - 4; z += step) {
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

void draw_bones(Svg& svg, const Axes& axes, const Model& m) {
  for (const auto* surface : {&m.palate, &m.jaw, &m.hyoid})
    if (*surface)
      for (const auto& cut : midsagittal_cut(**surface))
        svg.polyline(axes, in_mm(cut), {bone, "none", 2});
}

/// The usual frame, made larger at one scale for all of the lines [mm].
Axes around(const std::vector<std::vector<Eigen::Vector2d>>& lines, double left) {
  Axes axes{38, 148, 44, 134, left, 44, 484, 396};
  for (const auto& line : lines)
    for (const Eigen::Vector2d& p : line) {
      axes.x0 = std::min(axes.x0, p[0] - 5), axes.x1 = std::max(axes.x1, p[0] + 5);
      axes.y0 = std::min(axes.y0, p[1] - 5), axes.y1 = std::max(axes.y1, p[1] + 5);
    }
  const double scale =
      std::max((axes.x1 - axes.x0) / axes.width, (axes.y1 - axes.y0) / axes.height);
  const double wider = (scale * axes.width - (axes.x1 - axes.x0)) / 2;
  const double higher = (scale * axes.height - (axes.y1 - axes.y0)) / 2;
  axes.x0 -= wider, axes.x1 += wider, axes.y0 -= higher, axes.y1 += higher;
  return axes;
}

void draw_panel(Svg& svg, const Model& m, const SidePanel& panel, double left) {
  std::vector<std::vector<Eigen::Vector2d>> lines;
  for (const DrawnShape& shape : panel.shapes) lines.push_back(in_mm(surface_line(m, shape.x)));
  const Axes axes = framed(svg, around(lines, left), panel.below);
  draw_bones(svg, axes, m);
  svg.polyline(axes, in_mm(surface_line(m, m.rest)), {grey, "none", 2.4});
  for (size_t i = 0; i < lines.size(); ++i)
    svg.polyline(axes, lines[i], {panel.shapes[i].colour, "none", 2.4});
}

}  // namespace

std::string draw_shape(const Model& given, const Positions& x, const std::string& title) {
  const auto here = at_anatomy(given);
  const Model& m = *here;
  Svg svg(1060, 520);
  svg.text(50, 28, title, 16, "start", "#111");
  const Axes side = framed(svg, {38, 148, 44, 134, 50, 44, 530, 434}, "x [mm], lips left");
  draw_bones(svg, side, m);
  svg.polyline(side, in_mm(surface_line(m, m.rest)), {grey, "none", 2.4});
  svg.polyline(side, in_mm(surface_line(m, x)), {blue, "none", 2.6});
  const Axes front = framed(svg, {-45, 45, 44, 134, 616, 44, 434, 434}, "y [mm], from the front");
  draw_front(svg, front, m, m.rest, {"#c9cdd1", "none", 1});
  draw_front(svg, front, m, x, {blue, "none", 1});
  return svg.str();
}

std::string draw_side_by_side(const Model& given, const std::vector<SidePanel>& panels,
                              const std::string& title) {
  const auto here = at_anatomy(given);
  Svg svg(50 + 530.0 * double(std::max<size_t>(panels.size(), 1)), 480);
  svg.text(50, 28, title, 16, "start", "#111");
  double left = 190;
  const auto legend = [&](const std::string& name, const std::string& colour) {
    svg.line(left, 23, left + 22, 23, {colour, "none", 3});
    svg.text(left + 28, 28, name, 12, "start");
    left += 48 + 7 * double(name.size());
  };
  legend("rest", grey);
  if (!panels.empty())
    for (const DrawnShape& shape : panels.front().shapes) legend(shape.name, shape.colour);
  for (size_t i = 0; i < panels.size(); ++i)
    draw_panel(svg, *here, panels[i], 50 + 530.0 * double(i));
  return svg.str();
}

}  // namespace genio
