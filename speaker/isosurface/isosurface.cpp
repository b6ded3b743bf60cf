#include "speaker/isosurface/isosurface.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "speaker/solid/surface_figures.hpp"

namespace genio {
namespace {

constexpr size_t most_triangles = 12000000;
constexpr double least_way = 0.02;  // of a vertex from the grid's nodes, over the edge's length
constexpr float outside = std::numeric_limits<float>::max();

// A cell's corners are numbered by bits: 1 along u, 2 along v, 4 along w. A tetrahedron goes from
// corner 0 to corner 7 along the three axes in some order; the middle two are swapped where that
// makes it right-handed.
constexpr int tetrahedra[6][4] = {{0, 1, 3, 7}, {0, 2, 6, 7}, {0, 4, 5, 7},
                                  {0, 3, 2, 7}, {0, 5, 1, 7}, {0, 6, 4, 7}};
// Even orders of a tetrahedron's corners, those inside first: by the set of corners inside.
constexpr int one_inside[4][4] = {{0, 1, 2, 3}, {1, 0, 3, 2}, {2, 3, 0, 1}, {3, 2, 1, 0}};
constexpr int two_inside[6][4] = {{0, 1, 2, 3}, {0, 2, 3, 1}, {0, 3, 1, 2},
                                  {1, 2, 0, 3}, {1, 3, 2, 0}, {2, 3, 0, 1}};

/// The axis with one node more at both ends.
std::vector<double> padded(const std::vector<double>& axis) {
  const size_t n = axis.size();
  const double step = n > 1 ? axis[1] - axis[0] : 1, last = n > 1 ? axis[n - 1] - axis[n - 2] : 1;
  std::vector<double> result = {axis.front() - step};
  result.insert(result.end(), axis.begin(), axis.end());
  result.push_back(axis.back() + last);
  return result;
}

class MarchingTetrahedra {
 public:
  MarchingTetrahedra(const LayeredField& field, const std::function<Vec3(const Vec3&)>& place)
      : field_(field), place_(place) {
    for (size_t d = 0; d < 3; ++d) axis_[d] = padded(field.axis[d]);
    nu_ = axis_[0].size(), nv_ = axis_[1].size();
    for (int side = 0; side < 2; ++side) {
      value_[side].assign(nu_ * nv_, outside);
      vertex_[side].assign(7 * nu_ * nv_, -1);
    }
  }

  TriangleSurface run() {
    for (size_t k = 0; k + 1 < axis_[2].size(); ++k) {
      if (k > 0) std::swap(value_[0], value_[1]), std::swap(vertex_[0], vertex_[1]);
      fill(k + 1);
      for (size_t j = 0; j + 1 < nv_; ++j)
        for (size_t i = 0; i + 1 < nu_; ++i) march(i, j, k);
    }
    if (enclosed_volume(surface_) < 0)  // `place` mirrors
      for (auto& t : surface_.triangles) std::swap(t[1], t[2]);
    return std::move(surface_);
  }

 private:
  /// Node k of w becomes the upper layer.
  void fill(size_t k) {
    std::fill(vertex_[1].begin(), vertex_[1].end(), -1);
    std::fill(value_[1].begin(), value_[1].end(), outside);
    const size_t nu = nu_ - 2, nv = nv_ - 2;
    if (k > field_.axis[2].size()) return;
    row_.resize(nu * nv);
    field_.layer(int(k) - 1, row_);
    for (size_t j = 0; j < nv; ++j)
      std::copy_n(row_.begin() + std::ptrdiff_t(j * nu), nu,
                  value_[1].begin() + std::ptrdiff_t((j + 1) * nu_ + 1));
  }

  struct Cell {
    size_t i, j, k;
    float value[8];
  };

  size_t node(const Cell& cell, int corner) const {
    return (cell.j + ((corner >> 1) & 1)) * nu_ + cell.i + (corner & 1);
  }

  Vec3 corner_place(const Cell& cell, int corner) const {
    return {axis_[0][cell.i + (corner & 1)], axis_[1][cell.j + ((corner >> 1) & 1)],
            axis_[2][cell.k + ((corner >> 2) & 1)]};
  }

  /// The vertex on the edge between two corners, of which one holds the other's bits.
  int vertex(const Cell& cell, int a, int b) {
    const int low = a & b, high = a | b;
    int& index = vertex_[low >> 2][7 * node(cell, low) + size_t(high ^ low) - 1];
    if (index < 0) {
      index = int(surface_.vertices.size());
      const double from = cell.value[low], to = cell.value[high];
      const double t = std::clamp(from / (from - to), least_way, 1 - least_way);
      surface_.vertices.push_back(
          place_((1 - t) * corner_place(cell, low) + t * corner_place(cell, high)));
    }
    return index;
  }

  void add(int a, int b, int c) {
    if (surface_.triangles.size() >= most_triangles)
      throw InputError(
          fmt::format("the surface has more than {} million triangles; expected a "
                      "coarser grid",
                      most_triangles / 1000000));
    surface_.triangles.push_back({a, b, c});
  }

  void march(size_t i, size_t j, size_t k) {
    Cell cell{i, j, k, {}};
    int inside = 0;
    for (int c = 0; c < 8; ++c) {
      cell.value[c] = value_[c >> 2][node(cell, c)];
      inside += cell.value[c] < 0;
    }
    if (inside == 0 || inside == 8) return;
    for (const auto& t : tetrahedra) {
      const auto in = [&](int n) { return cell.value[t[n]] < 0; };
      const auto edge = [&](int a, int b) { return vertex(cell, t[a], t[b]); };
      const int count = in(0) + in(1) + in(2) + in(3);
      for (const auto& [a, b, c, d] : one_inside) {
        if (count == 1 && in(a)) add(edge(a, b), edge(a, c), edge(a, d));
        if (count == 3 && !in(a)) add(edge(a, b), edge(a, d), edge(a, c));
      }
      if (count != 2) continue;
      for (const auto& [a, b, c, d] : two_inside) {
        if (!in(a) || !in(b)) continue;
        const int e[4] = {edge(a, c), edge(a, d), edge(b, d), edge(b, c)};
        add(e[0], e[1], e[2]);
        add(e[0], e[2], e[3]);
      }
    }
  }

  const LayeredField& field_;
  const std::function<Vec3(const Vec3&)>& place_;
  std::array<std::vector<double>, 3> axis_;
  size_t nu_, nv_;
  std::vector<float> value_[2], row_;
  std::vector<int> vertex_[2];  ///< 7 a node, by the bits along which an edge leaves it
  TriangleSurface surface_;
};

}  // namespace

TriangleSurface isosurface(const LayeredField& field,
                           const std::function<Vec3(const Vec3&)>& place) {
  return MarchingTetrahedra(field, place).run();
}

}  // namespace genio
