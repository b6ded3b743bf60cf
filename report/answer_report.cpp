#include "report/answer_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "forward/base/text_file.hpp"
#include "inverse/target/tongue_line.hpp"
#include "report/svg.hpp"
#include "runs/results/answer_record.hpp"

namespace genio {
namespace {

/// Each set of names once: two directions may name the same commands.
std::vector<std::vector<std::string>> told_once(const std::vector<std::vector<std::string>>& all) {
  std::set<std::vector<std::string>> known;
  std::vector<std::vector<std::string>> result;
  for (const auto& group : all) {
    auto sorted = group;
    std::sort(sorted.begin(), sorted.end());
    if (known.insert(sorted).second) result.push_back(group);
  }
  return result;
}

}  // namespace

std::string to_table(const AnswerView& v) {
  std::string out;
  if (!v.muscles.empty())
    out += fmt::format("{:<8} {:>9} {:>8} {:>9}   {}\n", "muscle", "force N", "% max", "+- sd N",
                       "90 % interval N");
  for (const auto& c : v.muscles)
    out += fmt::format("{:<8} {:9.2f} {:8.1f} {:9.2f}   {:.2f} to {:.2f}\n", c.name, c.best,
                       100 * c.best / c.maximum, c.sd, c.low, c.high);
  for (const auto& c : v.others)
    out += fmt::format("{:<18} {:.3g} +- {:.2g} {}   {:.3g} to {:.3g}\n", c.name, c.best, c.sd,
                       c.unit, c.low, c.high);
  if (!v.muscles.empty())
    out += fmt::format("fit      RMS {:.2f} mm, max {:.2f} mm, chi2/dof {:.2f}\n", v.rms_mm,
                       v.max_mm, v.chi2_per_dof);
  for (const auto& group : told_once(v.unidentified))
    out += fmt::format("unseen   the data {}: {}\n",
                       group.size() > 1 ? "cannot tell apart" : "say little about",
                       fmt::join(group, ", "));
  for (const auto& other : v.alternatives) {
    out += fmt::format("also     weight {:.2f} (this one {:.2f}), RMS {:.2f} mm:", other.weight,
                       v.weight, 1e3 * other.rms);
    for (const auto& c : other.muscles)
      if (c.best > 0.01 * c.maximum) out += fmt::format(" {} {:.2f} N", c.name, c.best);
    out += "\n";
  }
  if (v.outliers > 0)
    out += fmt::format("outliers {} values beyond three standard deviations\n", v.outliers);
  out += fmt::format("status   {}\nverdict  {}{}{}\n", v.status, v.verdict,
                     v.message.empty() ? "" : ": ", v.message);
  return out;
}

std::string to_line(const AnswerView& v) {
  constexpr size_t shown = 3;
  std::string out = v.title + ": ";
  if (v.status != "converged")
    return out + fmt::format("{}{}{}", v.status, v.message.empty() ? "" : ": ", v.message);
  out += fmt::format("{}, RMS {:.2f} mm", v.verdict, v.rms_mm);
  std::vector<Estimate> largest = v.muscles;
  std::stable_sort(largest.begin(), largest.end(), [](const Estimate& a, const Estimate& b) {
    return a.best / a.maximum > b.best / b.maximum;
  });
  for (size_t i = 0; i < std::min(shown, largest.size()); ++i)
    out += fmt::format("{}{} {:.2f} N", i == 0 ? "; " : ", ", largest[i].name, largest[i].best);
  return out;
}

namespace {

constexpr const char* red = "#c8443a";

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
  for (const auto* surface : {&model.palate, &model.jaw, &model.hyoid})
    if (*surface)
      for (const auto& cut : midsagittal_cut(**surface))
        svg.polyline(axes, in_mm(cut), {bone, "none", 2.2});
  svg.polyline(axes, in_mm(TongueLine(model).sample(model.rest, 120)), {grey, "none", 2, "6,4"});
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
  for (const auto& c : v.muscles) most = std::max(most, std::min(1.0, c.high / c.maximum));
  const Axes axes{0, 100 * most * 1.05, 0, double(n), 700, 56, 330, 450};
  svg.rect(axes.left, axes.top, axes.width, axes.height, {"#ccc"});
  const double step = most > 0.5 ? 20 : most > 0.2 ? 10 : most > 0.1 ? 5 : 1;
  for (double p = 0; p <= axes.x1; p += step) {
    svg.line(axes.px(p), axes.top, axes.px(p), axes.top + axes.height, {"#eee"});
    svg.text(axes.px(p), axes.top + axes.height + 16, fmt::format("{}", p), 11, "middle", "#777");
  }
  svg.text(axes.left + axes.width / 2, axes.top + axes.height + 34,
           "force, % of maximum; bar: 90 % interval", 12, "middle", "#555");
  for (size_t i = 0; i < v.muscles.size(); ++i) {
    const auto& c = v.muscles[i];
    const double y0 = axes.py(double(n - i) - 0.2), y1 = axes.py(double(n - i) - 0.8),
                 mid = (y0 + y1) / 2;
    const auto px = [&](double force) { return axes.px(100 * force / c.maximum); };
    svg.rect(axes.left, y0, px(c.best) - axes.left, y1 - y0, {"none", blue});
    svg.line(px(c.low), mid, px(c.high), mid, {"#222", "none", 1.6});
    for (double end : {c.low, c.high})
      svg.line(px(end), mid - 4, px(end), mid + 4, {"#222", "none", 1.6});
    svg.text(axes.left - 8, mid + 4, c.name, 12, "end");
    svg.text(axes.left + axes.width + 8, mid + 4, fmt::format("{:.2f} N", c.best), 11, "start");
  }
}

}  // namespace

std::string draw(const Model& model, const AnswerView& v) {
  Svg svg(1110, 560);
  svg.text(50, 30, v.title, 17, "start", "#111");
  svg.text(1060, 30,
           fmt::format("{}; RMS {:.2f} mm, max {:.2f} mm",
                       v.verdict == "none" ? v.status : v.verdict, v.rms_mm, v.max_mm),
           14, "end", "#111");
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
  std::string csv = "muscle,force_N,max_force_N,sd_N,low90_N,high90_N\n";
  for (const auto& c : v.muscles)
    csv += fmt::format("{},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g}\n", c.name, c.best, c.maximum, c.sd,
                       c.low, c.high);
  write_text(base + ".csv", csv);
}

}  // namespace genio
