#pragma once
#include <optional>
#include <utility>
#include <vector>

#include "forward/geometry/triangle_surface.hpp"

namespace genio {

/// Triangles whose edges collapse one after the other. What is closed and manifold stays so, with
/// the same Euler number.
class CollapsingMesh {
 public:
  explicit CollapsingMesh(const TriangleSurface& surface);

  int triangle_count() const { return count_; }
  size_t all_vertices() const { return place_.size(); }
  size_t all_triangles() const { return corner_.size(); }
  const Vec3& place(int vertex) const { return place_[size_t(vertex)]; }
  const std::array<int, 3>& corners(int triangle) const { return corner_[size_t(triangle)]; }
  const std::vector<int>& around(int vertex) const { return around_[size_t(vertex)]; }
  bool on_rim(int vertex) const { return kind_[size_t(vertex)] == Kind::rim; }
  /// The vertices that share an edge with one, rising.
  std::vector<int> neighbours(int vertex) const;

  /// True where joining a and b changes no topology: what both are linked to is the two triangles
  /// between them alone (the link condition of Dey and others 1999).
  bool may_join(int a, int b) const;
  /// True where no triangle turns over, or loses its shape, with a and b at `at`.
  bool keeps_shape(int a, int b, const Vec3& at) const;
  /// The triangles of a and of b, each once, and whether the collapse leaves it.
  std::vector<std::pair<int, bool>> affected(int a, int b) const;
  /// b becomes a, which moves to `at`.
  void join(int a, int b, const Vec3& at);

  TriangleSurface surface() const;

 private:
  enum class Kind : char { inner, rim, locked };
  bool has(int triangle, int vertex) const;

  std::vector<Vec3> place_;
  std::vector<std::array<int, 3>> corner_;
  std::vector<bool> alive_;  ///< triangles
  std::vector<std::vector<int>> around_;
  std::vector<Kind> kind_;  ///< locked: at an edge of three triangles, or at two fans
  int count_;
};

}  // namespace genio
