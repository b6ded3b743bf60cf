#include "speaker/adaptation/model_line.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "forward/geometry/hex8.hpp"

namespace genio {
namespace {

std::vector<Quad> faces_in_plane(const HexMesh& mesh) {
  std::map<Quad, Quad> found;  // sorted nodes -> nodes in turn
  for (const auto& element : mesh.elements)
    for (const auto& f : hex8::face) {
      const Quad quad = {element[size_t(f[0])], element[size_t(f[1])], element[size_t(f[2])],
                         element[size_t(f[3])]};
      if (!std::all_of(quad.begin(), quad.end(),
                       [&](int a) { return std::abs(mesh.nodes[size_t(a)][1]) < on_plane; }))
        continue;
      Quad key = quad;
      std::sort(key.begin(), key.end());
      found.try_emplace(key, quad);
    }
  std::vector<Quad> faces;
  for (const auto& [key, quad] : found) {
    // Counter-clockwise with x backwards as the first axis and z as the second.
    std::vector<Vec2> corners;
    for (int a : quad) corners.emplace_back(mesh.nodes[size_t(a)][0], mesh.nodes[size_t(a)][2]);
    faces.push_back(quad);
    if (doubled_area(corners) < 0) std::reverse(faces.back().begin(), faces.back().end());
  }
  return faces;
}

/// The longest closed line of edges that one face has, clockwise.
std::vector<int> line_about(const std::vector<Quad>& faces) {
  std::set<std::pair<int, int>> sides;
  for (const Quad& q : faces)
    for (size_t i = 0; i < 4; ++i) sides.insert({q[i], q[(i + 1) % 4]});
  std::map<int, int> next;  // against the faces' sense
  for (const auto& [a, b] : sides)
    if (!sides.contains({b, a})) next[b] = a;
  std::vector<int> longest;
  while (!next.empty()) {
    std::vector<int> loop;
    for (int a = next.begin()->first; next.contains(a);) {
      loop.push_back(a);
      const int following = next.at(a);
      next.erase(a);
      a = following;
    }
    if (loop.size() > longest.size()) longest = loop;
  }
  return longest;
}

}  // namespace

std::vector<Vec2> ModelLine::places(const Positions& x) const {
  std::vector<Vec2> result;
  for (size_t k = 0; k <= vallecula; ++k) result.emplace_back(x[3 * nodes[k]], x[3 * nodes[k] + 2]);
  return result;
}

TongueLandmarks ModelLine::landmarks(const Positions& x) const {
  const Polyline line(places(x));
  TongueLandmarks marks;
  marks.genial = line.arc()[genial], marks.floor = line.arc()[floor];
  marks.vallecula = line.length();
  marks.tip = foremost(line, marks.floor, 0.5 * (marks.floor + marks.vallecula));
  return marks;
}

ModelLine model_line(const ModelDescription& model, const std::string& source) {
  ModelLine line;
  line.faces = faces_in_plane(model.mesh);
  if (line.faces.empty())
    throw InputError(fmt::format(
        "{}: the mesh has no faces in the midsagittal plane y = 0; expected a mesh with such",
        source));
  std::vector<int> loop = line_about(line.faces);
  const size_t n = loop.size();
  const auto position = [&](int node) {
    return size_t(std::find(loop.begin(), loop.end(), node) - loop.begin());
  };
  const size_t front = position(model.midsagittal.front()),
               root = position(model.midsagittal.back());
  const size_t tip = position(model.landmarks.tip);
  if (front == n || root == n || tip == n)
    throw InputError(fmt::format(
        "{}: the midsagittal curve or the tip does not lie on the edge of the midsagittal plane's "
        "faces",
        source));
  const auto support = [&](size_t k) { return model.supports[size_t(loop[k % n])]; };
  // From the front of the free surface down the mandible, and back along the floor.
  size_t back = 0;
  const auto go_back = [&](auto until, const char* what) {
    for (; back < n; ++back)
      if (until(support(front + n - back))) return front + n - back;
    throw InputError(
        fmt::format("{}: no node of the midsagittal line is held at the {}", source, what));
  };
  const size_t floor = go_back([](Support s) { return s == Support::fixed; }, "mandible");
  const size_t genial = go_back([](Support s) { return s != Support::fixed; }, "mandible") + 1;
  const size_t hyoid = go_back([](Support s) { return s == Support::horizontal; }, "hyoid");
  std::rotate(loop.begin(), loop.begin() + std::ptrdiff_t(hyoid % n), loop.end());
  line.nodes = loop;
  const auto from_hyoid = [&](size_t k) { return (k + n - hyoid % n) % n; };
  line.genial = from_hyoid(genial), line.floor = from_hyoid(floor), line.tip = from_hyoid(tip);
  line.vallecula = from_hyoid(root);
  if (!(line.genial < line.floor && line.floor < line.tip && line.tip < line.vallecula))
    throw InputError(fmt::format(
        "{}: the midsagittal line does not run from the hyoid over mandible, tip and dorsum",
        source));
  return line;
}

}  // namespace genio
