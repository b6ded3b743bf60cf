#pragma once
// Scalable drawings: a canvas in data units, and PNG of what was drawn.

#include <Eigen/Core>
#include <string>
#include <vector>

namespace genio {

/// Maps a data rectangle onto a rectangle of the picture (pixels, y down).
struct Axes {
  double x0, x1, y0, y1;            ///< data
  double left, top, width, height;  ///< picture
  double px(double x) const { return left + (x - x0) / (x1 - x0) * width; }
  double py(double y) const { return top + (y1 - y) / (y1 - y0) * height; }
};

/// Colours that mean the same in every picture.
inline constexpr const char *grey = "#9aa0a6", *blue = "#1f5fa8", *red = "#c8443a",
                            *bone = "#6b5b45";

/// Metres to millimetres.
std::vector<Eigen::Vector2d> in_mm(std::vector<Eigen::Vector2d> points);

struct Style {
  std::string stroke = "none", fill = "none";
  double width = 1;
  std::string dash = {};
};

class Svg {
 public:
  Svg(double width, double height);
  void line(double x0, double y0, double x1, double y1, const Style& s);
  void rect(double x, double y, double w, double h, const Style& s);
  void circle(double x, double y, double r, const Style& s);
  /// Points in the data units of `axes`.
  void polyline(const Axes& axes, const std::vector<Eigen::Vector2d>& points, const Style& s);
  void text(double x, double y, const std::string& words, double size, const std::string& anchor,
            const std::string& colour = "#333");
  std::string str() const;

 private:
  double width_, height_;
  std::string body_;
};

/// Text for SVG and HTML: &, < and > as entities.
std::string escaped(const std::string& text);

/// Renders SVG text to a PNG file at `scale` times its size. Throws InputError naming the path
/// where that cannot be written, std::runtime_error where the text is no drawing.
void write_png(const std::string& path, const std::string& svg, double scale);

}  // namespace genio
