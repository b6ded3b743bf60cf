#pragma once

#include <algorithm>

#include "forward/base/types.hpp"
#include "forward/geometry/mesh.hpp"
#include "forward/geometry/quad4.hpp"

namespace genio::bench {

/// Nodal forces that a constant nominal stress P puts on the faces whose nodes all satisfy
/// `on_face` [N].
template <class OnFace>
void add_traction(const HexMesh& mesh, const Mat3& stress, OnFace on_face, Forces& f) {
  for (const Quad& face : boundary_quads(mesh)) {
    const auto place = [&](int a) -> const Vec3& { return mesh.nodes[size_t(face[size_t(a)])]; };
    if (!std::all_of(face.begin(), face.end(),
                     [&](int a) { return on_face(mesh.nodes[size_t(a)]); }))
      continue;
    for (const auto& q : quad4::gauss_points()) {
      Vec3 g1 = Vec3::Zero(), g2 = Vec3::Zero();
      for (int a = 0; a < 4; ++a) g1 += q.by[a][0] * place(a), g2 += q.by[a][1] * place(a);
      const Vec3 area(g1[1] * g2[2] - g1[2] * g2[1], g1[2] * g2[0] - g1[0] * g2[2],
                      g1[0] * g2[1] - g1[1] * g2[0]);
      for (int a = 0; a < 4; ++a) f.segment<3>(3 * face[size_t(a)]) += q.value[a] * (stress * area);
    }
  }
}

}  // namespace genio::bench
