#include "speaker/elastic/mirror_halves.hpp"

#include <algorithm>
#include <map>

namespace genio {
namespace {

constexpr double same_image = 1e-5;  // published coordinates are rounded [m]

}  // namespace

Positions MirrorHalves::on_both(const Positions& of_half) const {
  Positions x(3 * Eigen::Index(in_half.size()));
  for (size_t a = 0; a < in_half.size(); ++a) {
    x.segment<3>(3 * Eigen::Index(a)) = node_position(of_half, in_half[a]);
    if (left[a]) x[3 * Eigen::Index(a) + 1] *= -1;
  }
  return x;
}

MirrorHalves mirror_halves(const HexMesh& mesh) {
  MirrorHalves m;
  const size_t n = mesh.nodes.size();
  m.in_half.assign(n, -1), m.left.assign(n, false);
  std::multimap<double, int> right;  // by x
  for (size_t a = 0; a < n; ++a) {
    if (mesh.nodes[a][1] < -on_plane) continue;
    m.in_half[a] = int(m.whole.size());
    if (mesh.nodes[a][1] > on_plane) right.emplace(mesh.nodes[a][0], int(a));
    m.whole.push_back(int(a));
    m.half.nodes.push_back(mesh.nodes[a]);
    if (std::abs(mesh.nodes[a][1]) <= on_plane) m.half.nodes.back()[1] = 0;
  }
  for (size_t a = 0; a < n; ++a) {
    if (m.in_half[a] >= 0) continue;
    const Vec3 image(mesh.nodes[a][0], -mesh.nodes[a][1], mesh.nodes[a][2]);
    for (auto it = right.lower_bound(image[0] - same_image);
         it != right.end() && it->first < image[0] + same_image; ++it)
      if ((mesh.nodes[size_t(it->second)] - image).norm() < same_image)
        m.in_half[a] = m.in_half[size_t(it->second)];
    if (m.in_half[a] < 0) return {};
    m.left[a] = true;
  }
  for (const auto& element : mesh.elements) {
    double side = 0;
    for (int a : element) side += mesh.nodes[size_t(a)][1];
    if (side < 0) continue;
    std::array<int, 8> e{};
    for (size_t i = 0; i < 8; ++i) {
      if (m.left[size_t(element[i])]) return {};  // an element across the plane
      e[i] = m.in_half[size_t(element[i])];
    }
    m.half.elements.push_back(e);
  }
  return 2 * m.half.elements.size() == mesh.elements.size() ? m : MirrorHalves{};
}

}  // namespace genio
