#include "forward/tissue/tongue_faces.hpp"

#include <algorithm>

namespace genio {

bool moves_freely(Support s) { return s == Support::free || s == in_midplane; }

std::vector<Quad> outer_faces(const HexMesh& mesh, const std::vector<Support>& supports) {
  std::vector<Quad> faces = boundary_quads(mesh);
  std::erase_if(faces, [&](const Quad& f) {
    return std::all_of(f.begin(), f.end(),
                       [&](int n) { return supports[size_t(n)] == in_midplane; });
  });
  return faces;
}

std::vector<Quad> free_faces(const HexMesh& mesh, const std::vector<Support>& supports) {
  std::vector<Quad> faces = outer_faces(mesh, supports);
  std::erase_if(faces, [&](const Quad& f) {
    return std::any_of(f.begin(), f.end(),
                       [&](int n) { return !moves_freely(supports[size_t(n)]); });
  });
  return faces;
}

}  // namespace genio
