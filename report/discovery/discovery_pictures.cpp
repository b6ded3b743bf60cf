#include "report/discovery/discovery_pictures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/pictures/svg.hpp"

namespace genio {
namespace {

constexpr double panel = 250, gap = 20;  // [px]
constexpr double full_colour = 2e-3;     // [m]

std::string colour(double distance) {
  const double t = std::clamp(std::abs(distance) / full_colour, 0.0, 1.0);
  const int pale = int(225 - 200 * t);
  return distance > 0 ? fmt::format("rgb(215,{0},{0})", pale)
                      : fmt::format("rgb({0},{0},215)", pale);
}

void draw_map(Svg& svg, const ResidualMap& map, size_t condition, double left, double top,
              const std::string& title) {
  svg.rect(left, top, panel, panel, {"#ddd"});
  svg.text(left + 8, top + 16, title, 12, "start", "#444");
  Axes axes{1e9, -1e9, 1e9, -1e9, left + 15, top + 25, panel - 30, panel - 40};
  for (const MapPoint& p : map.points) {
    axes.x0 = std::min(axes.x0, p.place[0]), axes.x1 = std::max(axes.x1, p.place[0]);
    axes.y0 = std::min(axes.y0, p.place[2]), axes.y1 = std::max(axes.y1, p.place[2]);
  }
  const double size = std::max(axes.x1 - axes.x0, axes.y1 - axes.y0);
  axes.x1 = axes.x0 + size, axes.y1 = axes.y0 + size;
  for (const MapPoint& p : map.points)
    if (p.condition == condition)
      svg.circle(axes.px(p.place[0]), axes.py(p.place[2]), p.beyond ? 4.2 : 3.0,
                 {p.beyond ? "#111" : "none", colour(p.distance), p.beyond ? 1.2 : 0});
}

/// Points measured on or near the midsagittal plane, (x, z).
std::vector<Vec2> near_middle(const Target& t) {
  constexpr double near = 2e-3;  // [m]
  std::vector<Vec2> points;
  for (const CurvePoint& c : t.curve) points.push_back(c.position);
  for (const SurfacePoint& s : t.surface)
    if (std::abs(s.position[1]) < near) points.emplace_back(s.position[0], s.position[2]);
  for (const FleshPoint& f : t.flesh)
    if (!(std::abs(f.position[1]) > near)) points.emplace_back(f.position[0], f.position[2]);
  return points;
}

}  // namespace

std::string draw_maps(const Discovery& d, const Observations& o) {
  std::vector<size_t> shown;
  for (const MapPoint& p : d.map_before.points)
    if (shown.empty() || shown.back() != p.condition) shown.push_back(p.condition);
  Svg svg(2 * panel + 3 * gap, double(shown.size()) * (panel + gap) + gap);
  for (size_t i = 0; i < shown.size(); ++i) {
    const double top = gap + double(i) * (panel + gap);
    const std::string& name = o.conditions[shown[i]].name;
    draw_map(svg, d.map_before, shown[i], gap, top, name + ", before");
    draw_map(svg, d.map_after, shown[i], 2 * gap + panel, top, name + ", after");
  }
  return svg.str();
}

std::string draw_ranking(const Round& round, size_t most) {
  std::vector<const RankedCandidate*> shown;
  for (const RankedCandidate& r : round.candidates)
    if (r.score.visible && shown.size() < most) shown.push_back(&r);
  double low = 0, high = 1;
  for (const RankedCandidate* r : shown)
    low = std::min(low, r->log_odds), high = std::max(high, r->log_odds);
  constexpr double row = 22, left = 250, width = 380;
  Svg svg(left + width + 80, row * double(shown.size()) + 20);
  const auto x = [&](double v) { return left + (v - low) / (high - low) * width; };
  for (size_t i = 0; i < shown.size(); ++i) {
    const RankedCandidate& r = *shown[i];
    const double y = 10 + row * double(i), v = r.log_odds;
    svg.text(left - 8, y + 14, r.candidate.label(), 12, "end");
    svg.rect(std::min(x(0), x(v)), y + 2, std::max(1.0, std::abs(x(v) - x(0))), row - 6,
             {"none", r.refitted ? "#1f5fa8" : "#a9c3e0"});
    svg.text(std::max(x(0), x(v)) + 6, y + 14, fmt::format("{:.1f}", v), 11, "start", "#555");
  }
  return svg.str();
}

std::string draw_contours(const Discovery& d, const Observations& o) {
  constexpr size_t columns = 3;
  const size_t count = d.lines_before.size(), rows = (count + columns - 1) / columns;
  Svg svg(columns * (panel + gap) + gap, double(rows) * (panel + gap) + gap);
  Axes axes{1e9, -1e9, 1e9, -1e9, 0, 0, panel - 20, panel - 40};
  for (const ShapeLine& line : d.lines_before)
    for (const Vec2& p : line.points) {
      axes.x0 = std::min(axes.x0, p[0]), axes.x1 = std::max(axes.x1, p[0]);
      axes.y0 = std::min(axes.y0, p[1]), axes.y1 = std::max(axes.y1, p[1]);
    }
  const double size = std::max((axes.x1 - axes.x0) / axes.width, (axes.y1 - axes.y0) / axes.height);
  axes.x1 = axes.x0 + size * axes.width, axes.y1 = axes.y0 + size * axes.height;
  for (size_t i = 0; i < count; ++i) {
    const size_t row = i / columns;
    const double left = gap + double(i % columns) * (panel + gap);
    const double top = gap + double(row) * (panel + gap);
    const Condition& c = o.conditions[d.lines_before[i].condition];
    svg.rect(left, top, panel, panel, {"#ddd"});
    svg.text(left + 8, top + 16, c.name + (c.heldout ? ", held out" : ""), 12, "start", "#444");
    axes.left = left + 10, axes.top = top + 30;
    svg.polyline(axes, d.lines_before[i].points, {"#9aa0a6", "none", 2, "4 3"});
    if (i < d.lines_after.size())
      svg.polyline(axes, d.lines_after[i].points, {"#1f5fa8", "none", 2});
    for (const Vec2& p : near_middle(c.target))
      svg.circle(axes.px(p[0]), axes.py(p[1]), 2, {"none", "#c0392b"});
  }
  return svg.str();
}

}  // namespace genio
