#include "forward/geometry/triangle_surface.hpp"

#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <filesystem>
#include <map>
#include <queue>

#include "forward/base/printed_text.hpp"
#include "forward/base/text_file.hpp"

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
        for (int other : by_edge[{std::min(a, b), std::max(a, b)}]) {
          if (done[other]) continue;
          if (runs(other, a, b)) std::swap(s.triangles[other][1], s.triangles[other][2]);
          done[other] = true;
          queue.push(other);
        }
      }
    }
  }
}

}  // namespace

TriangleSurface read_surface(const std::string& path) {
  if (!std::filesystem::exists(path)) throw InputError(path + ": no such file");
  Assimp::Importer importer;
  importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE,
                              aiPrimitiveType_LINE | aiPrimitiveType_POINT);
  importer.SetPropertyInteger(AI_CONFIG_PP_RVC_FLAGS,
                              aiComponent_NORMALS | aiComponent_TEXCOORDS | aiComponent_COLORS);
  const aiScene* scene = importer.ReadFile(
      path, aiProcess_Triangulate | aiProcess_RemoveComponent | aiProcess_JoinIdenticalVertices |
                aiProcess_SortByPType | aiProcess_PreTransformVertices);
  if (!scene)
    throw InputError(
        fmt::format("{}: cannot be read as STL, OBJ or PLY ({})", path, importer.GetErrorString()));
  TriangleSurface s;
  std::map<std::array<float, 3>, int> index;  // meshes of one file may repeat a vertex
  for (unsigned m = 0; m < scene->mNumMeshes; ++m) {
    const aiMesh& mesh = *scene->mMeshes[m];
    std::vector<int> local(mesh.mNumVertices);
    for (unsigned v = 0; v < mesh.mNumVertices; ++v) {
      const aiVector3D& p = mesh.mVertices[v];
      const auto [it, fresh] = index.try_emplace({p.x, p.y, p.z}, int(s.vertices.size()));
      if (fresh) s.vertices.emplace_back(p.x, p.y, p.z);
      local[v] = it->second;
    }
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
      if (mesh.mFaces[f].mNumIndices != 3) continue;
      const unsigned* i = mesh.mFaces[f].mIndices;
      const std::array<int, 3> t = {local[i[0]], local[i[1]], local[i[2]]};
      if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) s.triangles.push_back(t);
    }
  }
  if (s.triangles.empty()) throw InputError(path + ": the surface has no triangles");
  for (const Vec3& v : s.vertices)
    if (!v.allFinite()) throw InputError(path + ": a vertex is not finite");
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
