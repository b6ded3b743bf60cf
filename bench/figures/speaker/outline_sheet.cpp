#include "bench/figures/speaker/outline_sheet.hpp"

#include <fmt/format.h>

#include <cmath>

#include "forward/base/text_file.hpp"
#include "report/pictures/svg.hpp"
#include "speaker/adaptation/model_line.hpp"

namespace genio::bench {
namespace {

constexpr int columns = 7;
constexpr double tile = 260, span = 110;  // [pixels], [mm]

void draw_one(Svg& svg, const OutlineDrawing& d, double left, double top) {
  const Adaptation& a = d.adaptation;
  const Axes axes{40, 40 + span, 30, 30 + span, left, top, tile, tile};
  const ModelLine line = model_line(a.model, a.model.name);
  const auto place = [&](int n) {
    const Vec3& x = a.model.mesh.nodes[size_t(n)];
    return 1e3 * Eigen::Vector2d(x[0], x[2]);
  };
  for (const Quad& q : line.faces)
    svg.polyline(axes, {place(q[0]), place(q[1]), place(q[2]), place(q[3]), place(q[0])},
                 {.stroke = grey, .width = 0.4});
  for (const auto* surface : {&a.model.palate, &a.model.jaw, &a.model.hyoid})
    if (*surface)
      for (const auto& cut : midsagittal_cut(**surface))
        svg.polyline(axes, in_mm(cut), {.stroke = bone, .width = 1.2});
  for (const auto& [segment, points] : a.outline.segments)
    svg.polyline(axes, in_mm(points),
                 {.stroke = segment == Segment::tongue ? "#c0392b" : "#333",
                  .width = segment == Segment::tongue ? 1.0 : 0.6});
  svg.text(left + 6, top + 14,
           fmt::format("{}: {:.2f} mm, {:.2f}", d.speaker, 1e3 * a.distances.rms, a.min_jacobian),
           11, "start");
}

}  // namespace

void draw_outlines(const std::vector<OutlineDrawing>& drawings, const std::string& name) {
  const int rows = (int(drawings.size()) + columns - 1) / columns;
  Svg svg(columns * tile, rows * tile);
  for (size_t k = 0; k < drawings.size(); ++k)
    draw_one(svg, drawings[k], tile * double(int(k) % columns),
             tile * std::floor(double(k) / columns));
  write_text(name + ".svg", svg.str());
  write_png(name + ".png", svg.str(), 1.5);
}

}  // namespace genio::bench
