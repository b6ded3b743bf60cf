#include "report/answers/answer_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "forward/base/text_file.hpp"
#include "forward/model/at_anatomy.hpp"
#include "inverse/target/tongue_line.hpp"
#include "report/answers/answer_table.hpp"
#include "report/pictures/svg.hpp"
#include "runs/results/answer_record.hpp"
#include "runs/results/laid.hpp"
#include "runs/text/csv_text.hpp"

namespace genio {
namespace {

constexpr const char* red = "#c8443a";

/// Blue for what surely acts, paler for what may rest.
std::string shade(double acts) {
  const double part = std::isfinite(acts) ? 0.15 + 0.85 * acts : 1;
  const auto mixed = [&](int full) { return int(std::lround(255 - part * (255 - full))); };
  return fmt::format("#{:02x}{:02x}{:02x}", mixed(0x1f), mixed(0x5f), mixed(0xa8));
}

void draw_plane(Svg& svg, const Model& model, const AnswerView& v) {
  const Axes axes{38, 148, 44, 134, 50, 56, 550, 450};
  svg.rect(axes.left, axes.top, axes.width, axes.height, {"#ccc"});
  for (int x = 40; x <= 140; x += 20) {
    svg.line(axes.px(x), axes.top, axes.px(x), axes.top + axes.height, {"#eee"});
    svg.text(axes.px(x), axes.top + axes.height + 16, fmt::format("{}", x), 11, "middle", "#777");
  }
  for (int z = 60; z <= 120; z += 20) {
    svg.line(axes.left, axes.py(z), axes.left + axes.width, axes.py(z), {"#eee"});
    svg.text(axes.left - 6, axes.py(z) + 4, fmt::format("{}", z), 11, "end", "#777");
  }
  svg.text(axes.left + axes.width / 2, axes.top + axes.height + 34,
           "x [mm], lips left, pharynx right", 12, "middle", "#555");
  const auto here = at_anatomy(model);
  for (const auto* surface : {&here->palate, &here->jaw, &here->hyoid})
    if (*surface)
      for (const auto& cut : midsagittal_cut(**surface))
        svg.polyline(axes, in_mm(cut), {bone, "none", 2.2});
  svg.polyline(axes, in_mm(TongueLine(model).sample(here->rest, 120)), {grey, "none", 2, "6,4"});
  if (!v.predicted.empty()) svg.polyline(axes, in_mm(v.predicted), {blue, "none", 2.6});
  for (const Vec2& p : v.measured)
    svg.circle(axes.px(1e3 * p[0]), axes.py(1e3 * p[1]), 3, {"white", red, 0.7});
  struct Entry {
    const char *colour, *name;
  };
  double x = axes.left + 8;
  for (const Entry& e : {Entry{grey, "rest"},
                         {blue, "predicted"},
                         {red, "measured"},
                         {bone, "palate, jaw, hyoid"}}) {
    svg.line(x, axes.top + 14, x + 22, axes.top + 14, {e.colour, "none", 3});
    svg.text(x + 28, axes.top + 18, e.name, 12, "start");
    x += 100;
  }
}

void draw_forces(Svg& svg, const AnswerView& v) {
  const size_t n = std::max<size_t>(1, v.muscles.size());
  double most = 0.05;
  for (const auto& c : v.muscles)
    most = std::max(most, std::min(1.0, std::max(c.high, c.best) / c.maximum));
  const Axes axes{0, 100 * most * 1.05, 0, double(n), 700, 56, 330, 450};
  svg.rect(axes.left, axes.top, axes.width, axes.height, {"#ccc"});
  const double step = most > 0.5 ? 20 : most > 0.2 ? 10 : most > 0.1 ? 5 : 1;
  for (double p = 0; p <= axes.x1; p += step) {
    svg.line(axes.px(p), axes.top, axes.px(p), axes.top + axes.height, {"#eee"});
    svg.text(axes.px(p), axes.top + axes.height + 16, fmt::format("{}", p), 11, "middle", "#777");
  }
  svg.text(axes.left + axes.width / 2, axes.top + axes.height + 34,
           "force, % of maximum; bar: 90 % interval, line: median, ring: best fit", 12, "middle",
           "#555");
  if (std::any_of(v.muscles.begin(), v.muscles.end(),
                  [](const Estimate& c) { return std::isfinite(c.acts); }))
    svg.text(axes.left + axes.width + 8, axes.top - 6, "acts", 12, "start", "#555");
  for (size_t i = 0; i < v.muscles.size(); ++i) {
    const auto& c = v.muscles[i];
    const double y0 = axes.py(double(n - i) - 0.2), y1 = axes.py(double(n - i) - 0.8),
                 mid = (y0 + y1) / 2;
    const auto px = [&](double force) { return axes.px(100 * std::min(1.0, force / c.maximum)); };
    svg.rect(px(c.low), y0, px(c.high) - px(c.low), y1 - y0, {"none", shade(c.acts)});
    if (std::isfinite(c.median))
      svg.line(px(c.median), y0, px(c.median), y1, {"#222", "none", 2.2});
    svg.circle(px(c.best), mid, 4, {"#222", "white", 1.4});
    svg.text(axes.left - 8, mid + 4, c.name, 12, "end");
    if (std::isfinite(c.acts))
      svg.text(axes.left + axes.width + 8, mid + 4, percent_text(c.acts), 11, "start");
  }
}

}  // namespace

std::string draw(const Model& model, const AnswerView& v) {
  Svg svg(1110, 596);
  svg.text(50, 30, v.title, 17, "start", "#111");
  svg.text(1060, 30,
           fmt::format("{}; RMS {:.2f} mm, max {:.2f} mm",
                       v.verdict == "none" ? v.status : v.verdict, v.rms_mm, v.max_mm),
           14, "end", "#111");
  double y = 550;
  for (const std::string& line : laid_words(laid_in(v.registration)))
    svg.text(50, y += 16, line, 11, "start", "#555");
  draw_plane(svg, model, v);
  draw_forces(svg, v);
  return svg.str();
}

void write_report(const Model& model, const AnswerView& v, int frame, const std::string& folder,
                  const std::string& name) {
  make_folder(folder);
  const std::string base = (std::filesystem::path(folder) / name).string();
  const std::string picture = draw(model, v);
  write_text(base + ".svg", picture);
  write_png(base + ".png", picture, 1.5);
  write_text(base + ".json", answer_json(v, frame, 2) + "\n");
  std::string csv = "muscle,force_N,max_force_N,sd_N,low90_N,high90_N,acts,median_N,mean_N\n";
  for (const auto& c : v.muscles)
    csv += fmt::format("{},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{},{},{}\n", c.name, c.best,
                       c.maximum, c.sd, c.low, c.high, csv_number(c.acts, 6),
                       csv_number(c.median, 6), csv_number(c.mean, 6));
  write_text(base + ".csv", csv);
}

}  // namespace genio
