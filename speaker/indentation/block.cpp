#include "speaker/indentation/block.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace genio {
namespace {

using Point2 = std::array<double, 2>;

/// A punch takes along a part of the cells beyond its edge, as their displacements are linear: on
/// half spaces and layers its forces are those of a punch so much larger, in parts of a cell.
constexpr double edge_reach = 0.3;

/// From `from` to `to` in cells that begin with about `first` and grow, none above `most`; both
/// ends are in it.
std::vector<double> graded(double from, double to, double first, double growth, double most) {
  std::vector<double> sizes;
  double sum = 0;
  for (double size = std::min(first, most); sum < (to - from) * (1 - 1e-9);
       size = std::min(growth * size, most))
    sizes.push_back(size), sum += size;
  // The last cell that goes beyond is left out where that changes the others less.
  if (sizes.size() > 1 && sum - (to - from) > 0.5 * sizes.back())
    sum -= sizes.back(), sizes.pop_back();
  std::vector<double> points = {from};
  for (const double size : sizes) points.push_back(points.back() + size * (to - from) / sum);
  points.back() = to;
  return points;
}

/// Plane points by ring: the axis, squares of the core, circles, the outline of the block.
class Rings {
 public:
  Rings(const IndentationExperiment& e, double radius, const BlockGrid& grid)
      : core_(grid.core), width_(e.half_width) {
    const double step = std::numbers::pi / (4 * core_);
    as_circle_ = std::sqrt(step / std::sin(step));
    const bool sharp = e.indenter != Indenter::sphere;
    const double contact =
        e.indenter == Indenter::punch ? radius * (1 - edge_reach * grid.edge) : radius;
    // Of a punch only the edge needs small cells; a sphere's contact has its edge everywhere.
    const double cell = sharp ? 0.2 * contact : grid.edge * contact, edge = grid.edge * contact;
    const double square = std::min(0.5 * contact, 1.25 * core_ * cell);
    std::vector<double> inner =
        graded(0, contact - square, edge, grid.growth, std::max(cell, square / core_));
    for (size_t i = inner.size() - 1; i-- > 0;) radii_.push_back(contact - inner[i]);
    inner_ = int(radii_.size());
    square_ = square;
    // The sphere's contact may grow a little beyond.
    const double even = sharp ? contact : std::min(1.2 * contact, 0.8 * width_);
    if (!sharp)
      for (double r : graded(contact, even, edge, 1, edge))
        if (r > contact) radii_.push_back(r);
    for (double r : graded(even, width_, edge * grid.growth, grid.growth, 0.3 * width_))
      if (r > even) radii_.push_back(r);
    round_until_ = std::min(2 * contact, 0.5 * (contact + width_));
  }

  int count() const { return int(radii_.size()); }
  /// Rings within the contact, beside the core.
  int inner() const { return inner_; }

  /// Node (i, j) of the core.
  Point2 core(int i, int j) const {
    const int shell = std::max(i, j);
    if (shell == 0) return {0, 0};
    const double angle = std::numbers::pi / 4 * std::min(i, j) / shell;
    constexpr double round = 0.5;
    double along = (1 - round) * 0.85 + round * std::cos(angle),
           across = (1 - round) * 0.85 * std::min(i, j) / shell + round * std::sin(angle);
    const double scale = square_ * shell / core_;
    along *= scale, across *= scale;
    return i >= j ? Point2{along, across} : Point2{across, along};
  }

  /// Node q = 0 .. 2 core, from the x axis to the y axis, of ring k.
  Point2 ring(int k, int q) const {
    const double angle = std::numbers::pi / 4 * q / core_, r = radii_[size_t(k)];
    const double out = std::clamp((r - round_until_) / (width_ - round_until_), 0.0, 1.0);
    const double c = q == 2 * core_ ? 0 : std::cos(angle), s = q == 0 ? 0 : std::sin(angle);
    const double scale = r * ((1 - out) * as_circle_ + out / std::max(c, s));
    Point2 on{scale * c, scale * s};
    if (k >= inner_) return on;
    // From the core's rounded square to the circle at the contact's edge.
    const double t = (r - square_) / (radii_[size_t(inner_ - 1)] - square_);
    const Point2 from = q <= core_ ? core(core_, q) : core(2 * core_ - q, core_);
    const double edge = radii_[size_t(inner_ - 1)] * as_circle_;
    return {(1 - t) * from[0] + t * edge * c, (1 - t) * from[1] + t * edge * s};
  }

 private:
  int core_, inner_ = 0;
  double width_, square_ = 0, as_circle_ = 1, round_until_ = 0;
  std::vector<double> radii_;
};

/// Heights of the nodes from the bottom to the top, and the first of the mucosa.
std::pair<std::vector<double>, int> heights(const IndentationExperiment& e, double contact,
                                            const BlockGrid& grid) {
  const double h = e.thickness;
  double first = std::min(1.5 * grid.edge * contact, h / 5);
  std::vector<double> down = {0};
  size_t mucosa = 0;
  if (e.mucosa > 0) {
    first = std::min(first, e.mucosa / 2);
    down = graded(0, e.mucosa, first, grid.growth, e.mucosa);
    mucosa = down.size() - 1;
    first = grid.growth * (down[mucosa] - down[mucosa - 1]);
  }
  const auto below =
      graded(e.mucosa, h, std::min(first, (h - e.mucosa) / 3), grid.growth, 0.25 * h);
  down.insert(down.end(), below.begin() + 1, below.end());
  std::vector<double> up;
  for (size_t k = down.size(); k-- > 0;) up.push_back(h - down[k]);
  up.front() = 0;
  return {up, int(down.size() - 1 - mucosa)};
}

/// Faces of the plane mesh, counter-clockwise, those within the contact first.
struct PlaneMesh {
  std::vector<Point2> nodes;
  std::vector<std::array<int, 4>> faces;
  int pressed = 0;
};

PlaneMesh plane_mesh(const Rings& rings, int core) {
  PlaneMesh m;
  const int side = core + 1, around = 2 * core + 1;
  for (int j = 0; j <= core; ++j)
    for (int i = 0; i <= core; ++i) m.nodes.push_back(rings.core(i, j));
  for (int k = 0; k < rings.count(); ++k)
    for (int q = 0; q < around; ++q) m.nodes.push_back(rings.ring(k, q));
  for (int j = 0; j < core; ++j)
    for (int i = 0; i < core; ++i) {
      const int a = j * side + i;
      m.faces.push_back({a, a + 1, a + 1 + side, a + side});
    }
  const auto node = [&](int k, int q) {
    if (k >= 0) return side * side + k * around + q;
    return q <= core ? q * side + core : core * side + 2 * core - q;
  };
  for (int k = 0; k < rings.count(); ++k) {
    for (int q = 0; q + 1 < around; ++q)
      m.faces.push_back({node(k - 1, q), node(k, q), node(k, q + 1), node(k - 1, q + 1)});
    if (k + 1 == rings.inner()) m.pressed = int(m.faces.size());
  }
  return m;
}

}  // namespace

IndentedBlock indented_block(const IndentationExperiment& e, double contact,
                             const BlockGrid& grid) {
  const PlaneMesh plane = plane_mesh(Rings(e, contact, grid), grid.core);
  const auto [z, first_of_mucosa] = heights(e, contact, grid);
  IndentedBlock b;
  const int layer = int(plane.nodes.size()), layers = int(z.size()) - 1;
  for (int k = 0; k <= layers; ++k)
    for (const Point2& p : plane.nodes) {
      b.mesh.nodes.emplace_back(p[0], p[1], z[size_t(k)]);
      const bool on_x = p[0] < 1e-9, on_y = p[1] < 1e-9;
      b.supports.push_back(k == 0         ? Support::fixed
                           : on_x || on_y ? held_along(on_x, on_y, false)
                                          : Support::free);
    }
  for (int k = 0; k < layers; ++k)
    for (const auto& f : plane.faces) {
      std::array<int, 8> element;
      for (size_t a = 0; a < 4; ++a)
        element[a] = k * layer + f[a], element[a + 4] = (k + 1) * layer + f[a];
      b.mesh.elements.push_back(element);
      b.mucosa.push_back(e.mucosa > 0 && k >= first_of_mucosa);
    }
  for (size_t i = 0; i < plane.faces.size(); ++i) {
    const auto& f = plane.faces[i];
    b.top.push_back({layers * layer + f[0], layers * layer + f[1], layers * layer + f[2],
                     layers * layer + f[3]});
    b.pressed.push_back(int(i) < plane.pressed);
  }
  b.centre = layers * layer;
  return b;
}

}  // namespace genio
