#include "forward/geometry/triangle_surface.hpp"

#include <algorithm>
#include <map>
#include <queue>
#include <utility>

#include "forward/base/printed_text.hpp"
#include "forward/base/text_file.hpp"
#include "forward/polygons/polygons.hpp"
#include "forward/polygons/triangulate.hpp"

namespace genio {
namespace {

using Edge = std::pair<int, int>;

/// Turns triangles so that neighbours traverse their common edge in opposite directions.
void orient_consistently(TriangleSurface& s) {
  std::map<Edge, std::vector<int>> by_edge;
  for (size_t t = 0; t < s.triangles.size(); ++t)
    for (int i = 0; i < 3; ++i) {
      const int a = s.triangles[t][i], b = s.triangles[t][(i + 1) % 3];
      by_edge[{std::min(a, b), std::max(a, b)}].push_back(int(t));
    }
  const auto runs = [&](int t, int a, int b) {
    for (int i = 0; i < 3; ++i)
      if (s.triangles[t][i] == a && s.triangles[t][(i + 1) % 3] == b) return true;
    return false;
  };
  std::vector<bool> done(s.triangles.size(), false);
  for (size_t seed = 0; seed < s.triangles.size(); ++seed) {
    if (done[seed]) continue;
    std::queue<int> queue({int(seed)});
    done[seed] = true;
    for (; !queue.empty(); queue.pop()) {
      const int t = queue.front();
      for (int i = 0; i < 3; ++i) {
        const int a = s.triangles[t][i], b = s.triangles[t][(i + 1) % 3];
        // Behind this loop all triangles of the edge are done, so nobody has to look again.
        for (int other : std::exchange(by_edge[{std::min(a, b), std::max(a, b)}], {})) {
          if (done[other]) continue;
          if (runs(other, a, b)) std::swap(s.triangles[other][1], s.triangles[other][2]);
          done[other] = true;
          queue.push(other);
        }
      }
    }
  }
}

/// Points at one place are one vertex; those that no face has are none.
class VertexList {
 public:
  VertexList(const std::vector<Vec3>& points, const std::string& path)
      : points_(points), path_(path) {}
  int vertex(int point) {
    const Vec3& x = points_[size_t(point)];
    if (!x.allFinite()) throw InputError(path_ + ": a vertex is not finite");
    const auto [it, fresh] = index_.try_emplace({x[0], x[1], x[2]}, int(vertices_.size()));
    if (fresh) vertices_.push_back(x);
    return it->second;
  }
  std::vector<Vec3> take() { return std::move(vertices_); }

 private:
  const std::vector<Vec3>& points_;
  const std::string& path_;
  std::map<std::array<double, 3>, int> index_;
  std::vector<Vec3> vertices_;
};

}  // namespace

TriangleSurface read_surface(const std::string& path) {
  const Polygons polygons = read_polygons(path);
  const auto faces = triangulated(polygons, path);
  VertexList vertices(polygons.points, path);
  if (polygons.in_order) {
    std::vector<bool> used(polygons.points.size(), false);
    for (const auto& corners : faces)
      for (const int point : corners) used[size_t(point)] = true;
    for (size_t point = 0; point < used.size(); ++point)
      if (used[point]) vertices.vertex(int(point));
  }
  TriangleSurface s;
  for (const auto& c : faces) {
    const std::array<int, 3> t = {vertices.vertex(c[0]), vertices.vertex(c[1]),
                                  vertices.vertex(c[2])};
    if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) s.triangles.push_back(t);
  }
  if (s.triangles.empty()) throw InputError(path + ": the surface has no triangles");
  s.vertices = vertices.take();
  orient_consistently(s);
  return s;
}

void write_obj(const std::string& path, const TriangleSurface& surface) {
  PrintedText out;
  out.print("# metres; x backwards, y to the speaker's right, z up\n");
  for (const Vec3& v : surface.vertices) out.print("v {:.6f} {:.6f} {:.6f}\n", v[0], v[1], v[2]);
  for (const auto& t : surface.triangles) out.print("f {} {} {}\n", t[0] + 1, t[1] + 1, t[2] + 1);
  write_text(path, out.text);
}

std::vector<std::vector<Eigen::Vector2d>> midsagittal_cut(const TriangleSurface& s) {
  // A vertex on the plane itself counts as lying to the right, so that every crossing is an edge.
  std::map<Edge, Eigen::Vector2d> crossing;
  std::map<Edge, std::vector<Edge>> next;
  for (const auto& t : s.triangles) {
    std::vector<Edge> cut;
    for (int i = 0; i < 3; ++i) {
      int a = t[i], b = t[(i + 1) % 3];
      if (a > b) std::swap(a, b);
      const double ya = s.vertices[a][1], yb = s.vertices[b][1];
      if ((ya < 0) == (yb < 0)) continue;
      const Vec3 p = s.vertices[a] + ya / (ya - yb) * (s.vertices[b] - s.vertices[a]);
      crossing[{a, b}] = {p[0], p[2]};
      cut.emplace_back(a, b);
    }
    if (cut.size() == 2) {
      next[cut[0]].push_back(cut[1]);
      next[cut[1]].push_back(cut[0]);
    }
  }
  std::vector<std::vector<Eigen::Vector2d>> lines;
  std::map<Edge, bool> used;
  const auto walk = [&](Edge start) {
    std::vector<Eigen::Vector2d> line;
    for (Edge at = start;;) {
      used[at] = true;
      line.push_back(crossing[at]);
      const auto& n = next[at];
      const auto it = std::find_if(n.begin(), n.end(), [&](const Edge& e) { return !used[e]; });
      if (it == n.end()) {
        if (line.size() > 2 && std::find(n.begin(), n.end(), start) != n.end())
          line.push_back(crossing[start]);  // closed
        break;
      }
      at = *it;
    }
    lines.push_back(std::move(line));
  };
  for (const auto& [edge, neighbours] : next)  // open ends first, then rings
    if (neighbours.size() == 1 && !used[edge]) walk(edge);
  for (const auto& [edge, neighbours] : next)
    if (!used[edge]) walk(edge);
  const auto length = [](const std::vector<Eigen::Vector2d>& l) {
    double sum = 0;
    for (size_t i = 0; i + 1 < l.size(); ++i) sum += (l[i + 1] - l[i]).norm();
    return sum;
  };
  std::sort(lines.begin(), lines.end(),
            [&](const auto& a, const auto& b) { return length(a) > length(b); });
  return lines;
}

}  // namespace genio
