#include "report/pictures/plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/pictures/svg.hpp"

namespace genio {
namespace {

constexpr const char* colours[] = {"#1f5fa8", "#c8443a", "#2f8f5b", "#8a5fb0",
                                   "#b07d2b", "#555555", "#1aa3b8", "#d1589b",
                                   "#86a816", "#6b3a1e", "#8fb4e3", "#f0a080"};

/// Steps of 1, 2 or 5 times a power of ten, about six over the range.
double nice_step(double range) {
  const double rough = range / 6, power = std::pow(10, std::floor(std::log10(rough)));
  for (const double m : {1.0, 2.0, 5.0})
    if (rough <= m * power) return m * power;
  return 10 * power;
}

}  // namespace

std::string plot(const std::string& title, const std::string& x_label, const std::string& y_label,
                 const std::vector<Series>& series, bool log_x, bool log_y,
                 const std::vector<std::string>& notes) {
  const auto at = [&](const Eigen::Vector2d& p) {
    return Eigen::Vector2d(log_x ? std::log10(p[0]) : p[0], log_y ? std::log10(p[1]) : p[1]);
  };
  Eigen::Vector2d low(1e300, 1e300), high = -low;
  for (const Series& s : series)
    for (const auto& p : s.points) low = low.cwiseMin(at(p)), high = high.cwiseMax(at(p));
  const Eigen::Vector2d margin = 0.06 * (high - low).cwiseMax(1e-9);
  low -= margin, high += margin;
  Svg svg(720, 430 + 16.0 * double(notes.size()));
  svg.text(70, 22, title, 15, "start", "#111");
  const Axes axes{low[0], high[0], low[1], high[1], 70, 40, 420, 330};
  svg.rect(axes.left, axes.top, axes.width, axes.height, {"#ccc"});
  const auto label = [](double v, bool log) {
    return fmt::format("{:.4g}", log ? std::pow(10, v) : v + 0.0);  // of -0 it makes 0
  };
  const double sx = log_x ? std::log10(2.0) : nice_step(high[0] - low[0]),
               sy = log_y ? (high[1] - low[1] > 2 ? 1 : std::log10(2.0))
                          : nice_step(high[1] - low[1]);
  const double first_x = std::ceil(low[0] / sx), first_y = std::ceil(low[1] / sy);  // in steps
  for (int k = 0; (first_x + k) * sx <= high[0]; ++k) {
    const double v = (first_x + k) * sx;
    svg.line(axes.px(v), axes.top, axes.px(v), axes.top + axes.height, {"#eee"});
    svg.text(axes.px(v), axes.top + axes.height + 16, label(v, log_x), 11, "middle", "#777");
  }
  for (int k = 0; (first_y + k) * sy <= high[1]; ++k) {
    const double v = (first_y + k) * sy;
    svg.line(axes.left, axes.py(v), axes.left + axes.width, axes.py(v), {"#eee"});
    svg.text(axes.left - 6, axes.py(v) + 4, label(v, log_y), 11, "end", "#777");
  }
  svg.text(axes.left + axes.width / 2, axes.top + axes.height + 38, x_label, 12, "middle", "#555");
  svg.text(axes.left, axes.top - 2, y_label, 11, "start", "#555");
  for (size_t i = 0; i < series.size(); ++i) {
    const char* colour = colours[i % std::size(colours)];
    std::vector<Eigen::Vector2d> line;
    for (const auto& p : series[i].points) line.push_back(at(p));
    const char* dash = i < std::size(colours) ? "" : "5,4";  // the colours come round again
    svg.polyline(axes, line, {colour, "none", 2, dash});
    for (const auto& p : line) svg.circle(axes.px(p[0]), axes.py(p[1]), 3, {"white", colour, 0.7});
    const double y = axes.top + 16 + 20 * double(i);
    svg.line(506, y, 528, y, {colour, "none", 3, dash});
    svg.text(534, y + 4, series[i].name, 12, "start");
  }
  for (size_t i = 0; i < notes.size(); ++i)
    svg.text(axes.left, 430 + 16 * double(i), notes[i], 11, "start", "#555");
  return svg.str();
}

}  // namespace genio
