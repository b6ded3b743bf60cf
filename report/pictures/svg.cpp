#include "report/pictures/svg.hpp"

#include <cairo.h>
#include <fmt/format.h>
#include <librsvg/rsvg.h>

#include <algorithm>
#include <memory>
#include <stdexcept>

#include "forward/base/text_file.hpp"

namespace genio {
namespace {

std::string attributes(const Style& s) {
  return fmt::format("stroke=\"{}\" fill=\"{}\" stroke-width=\"{}\"{}", s.stroke, s.fill, s.width,
                     s.dash.empty() ? "" : fmt::format(" stroke-dasharray=\"{}\"", s.dash));
}

}  // namespace

std::vector<Eigen::Vector2d> in_mm(std::vector<Eigen::Vector2d> points) {
  for (auto& p : points) p *= 1e3;
  return points;
}

std::string escaped(const std::string& s) {
  std::string out;
  for (char c : s) {
    if (c == '&') out += "&amp;";
    else if (c == '<') out += "&lt;";
    else if (c == '>') out += "&gt;";
    else out += c;
  }
  return out;
}

Svg::Svg(double width, double height) : width_(width), height_(height) {
  rect(0, 0, width, height, {"none", "white"});
}

void Svg::line(double x0, double y0, double x1, double y1, const Style& s) {
  body_ += fmt::format("<line x1=\"{:.2f}\" y1=\"{:.2f}\" x2=\"{:.2f}\" y2=\"{:.2f}\" {}/>\n", x0,
                       y0, x1, y1, attributes(s));
}

void Svg::rect(double x, double y, double w, double h, const Style& s) {
  body_ += fmt::format("<rect x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" height=\"{:.2f}\" {}/>\n",
                       x, y, w, h, attributes(s));
}

void Svg::circle(double x, double y, double r, const Style& s) {
  body_ += fmt::format("<circle cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"{:.2f}\" {}/>\n", x, y, r,
                       attributes(s));
}

void Svg::polyline(const Axes& axes, const std::vector<Eigen::Vector2d>& points, const Style& s) {
  // What would leave the frame is put in a picture within the picture, which ends there.
  const bool inside = std::all_of(points.begin(), points.end(), [&](const Eigen::Vector2d& p) {
    return p[0] >= axes.x0 && p[0] <= axes.x1 && p[1] >= axes.y0 && p[1] <= axes.y1;
  });
  if (!inside)
    body_ += fmt::format(
        "<svg x=\"{0}\" y=\"{1}\" width=\"{2}\" height=\"{3}\" viewBox=\"{0} {1} {2} {3}\">",
        axes.left, axes.top, axes.width, axes.height);
  body_ += "<polyline stroke-linejoin=\"round\" points=\"";
  for (const auto& p : points) body_ += fmt::format("{:.1f},{:.1f} ", axes.px(p[0]), axes.py(p[1]));
  body_ += fmt::format("\" {}/>{}\n", attributes(s), inside ? "" : "</svg>");
}

void Svg::text(double x, double y, const std::string& words, double size, const std::string& anchor,
               const std::string& colour) {
  body_ += fmt::format(
      "<text x=\"{:.2f}\" y=\"{:.2f}\" font-size=\"{}\" text-anchor=\"{}\" fill=\"{}\" "
      "font-family=\"DejaVu Sans, Helvetica, Arial, sans-serif\">{}</text>\n",
      x, y, size, anchor, colour, escaped(words));
}

std::string Svg::str() const {
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} "
      "{1}\">\n{2}</svg>\n",
      width_, height_, body_);
}

void write_png(const std::string& path, const std::string& svg, double scale) {
  GError* error = nullptr;
  RsvgHandle* handle =
      rsvg_handle_new_from_data(reinterpret_cast<const guint8*>(svg.data()), svg.size(), &error);
  if (!handle) {
    const std::string why = error ? error->message : "unknown";
    g_clear_error(&error);
    throw std::runtime_error(path + ": the drawing cannot be rendered: " + why);
  }
  double width = 0, height = 0;
  rsvg_handle_get_intrinsic_size_in_pixels(handle, &width, &height);
  cairo_surface_t* surface =
      cairo_image_surface_create(CAIRO_FORMAT_ARGB32, int(width * scale), int(height * scale));
  cairo_t* cairo = cairo_create(surface);
  const RsvgRectangle area{0, 0, width * scale, height * scale};
  const bool drawn = rsvg_handle_render_document(handle, cairo, &area, &error);
  const std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)> whole(
      surface, cairo_surface_destroy);
  cairo_destroy(cairo);
  g_object_unref(handle);
  g_clear_error(&error);
  if (!drawn) throw std::runtime_error(path + ": the drawing cannot be rendered");
  cairo_status_t written = CAIRO_STATUS_SUCCESS;
  replace_file(path, [&](const std::string& file) {
    written = cairo_surface_write_to_png(surface, file.c_str());
    if (written != CAIRO_STATUS_SUCCESS)
      throw InputError(path + ": cannot be written: " + cairo_status_to_string(written));
  });
}

}  // namespace genio
