#include "forward/geometry/mesh.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <map>

#include "forward/geometry/hex8.hpp"

namespace genio {
namespace {

/// Jacobian determinant of element `e` in the shape `x` at the local point `xi` [m^3].
double jacobian_at(const HexMesh& mesh, const Positions& x, int e, const Vec3& xi) {
  const auto corner = [&](int a) -> Vec3 { return node_position(x, mesh.elements[e][a]); };
  return hex8::jacobian(corner, hex8::derivatives(xi)).determinant();
}

}  // namespace

Positions rest_positions(const HexMesh& mesh) {
  Positions x(3 * mesh.nodes.size());
  for (size_t a = 0; a < mesh.nodes.size(); ++a) x.segment<3>(3 * a) = mesh.nodes[a];
  return x;
}

std::array<double, 8> corner_jacobians(const HexMesh& mesh, int element) {
  const auto corner = [&](int a) -> const Vec3& { return mesh.nodes[mesh.elements[element][a]]; };
  std::array<double, 8> result;
  for (int c = 0; c < 8; ++c) {
    const Vec3 xi(hex8::corner[c][0], hex8::corner[c][1], hex8::corner[c][2]);
    result[c] = hex8::jacobian(corner, hex8::derivatives(xi)).determinant();
  }
  return result;
}

double corner_jacobian_ratio(const HexMesh& mesh, int element) {
  const auto j = corner_jacobians(mesh, element);
  const auto [low, high] = std::minmax_element(j.begin(), j.end());
  return *low / std::max(*high, 1e-300);
}

double element_volume(const HexMesh& mesh, const Positions& x, int element) {
  static const auto points = hex8::gauss_points();
  double volume = 0;
  for (const auto& xi : points) volume += jacobian_at(mesh, x, element, xi);
  return volume;
}

double mesh_volume(const HexMesh& mesh, const Positions& x) {
  double volume = 0;
  for (size_t e = 0; e < mesh.elements.size(); ++e) volume += element_volume(mesh, x, int(e));
  return volume;
}

std::vector<Quad> boundary_quads(const HexMesh& mesh) {
  std::map<Quad, std::pair<Quad, int>> seen;  // sorted nodes -> (oriented nodes, count)
  for (const auto& element : mesh.elements)
    for (const auto& f : hex8::face) {
      const Quad quad = {element[f[0]], element[f[1]], element[f[2]], element[f[3]]};
      Quad key = quad;
      std::sort(key.begin(), key.end());
      auto [it, fresh] = seen.try_emplace(key, quad, 0);
      ++it->second.second;
    }
  std::vector<Quad> quads;
  for (const auto& [key, entry] : seen)
    if (entry.second == 1) quads.push_back(entry.first);
  return quads;
}

std::vector<double> nodal_areas(const HexMesh& mesh, const std::vector<Quad>& quads) {
  std::vector<double> area(mesh.nodes.size(), 0.0);
  for (const auto& q : quads) {
    const Vec3 diagonal1 = mesh.nodes[q[2]] - mesh.nodes[q[0]];
    const Vec3 diagonal2 = mesh.nodes[q[3]] - mesh.nodes[q[1]];
    const double quarter = 0.25 * 0.5 * diagonal1.cross(diagonal2).norm();
    for (int node : q) area[node] += quarter;
  }
  return area;
}

NodeMatrix tissue_mass(const HexMesh& mesh, double density) {
  std::vector<Eigen::Triplet<double>> entries;
  for (const auto& element : mesh.elements)
    for (const auto& xi : hex8::gauss_points()) {
      const auto n = hex8::values(xi);
      const auto corner = [&](int a) -> const Vec3& { return mesh.nodes[element[a]]; };
      const double volume = hex8::jacobian(corner, hex8::derivatives(xi)).determinant();
      for (int a = 0; a < 8; ++a)
        for (int b = 0; b < 8; ++b)
          entries.emplace_back(element[a], element[b], density * n[a] * n[b] * volume);
    }
  const auto count = Eigen::Index(mesh.nodes.size());
  NodeMatrix mass(count, count);
  mass.setFromTriplets(entries.begin(), entries.end());
  return mass;
}

Vector multiply(const NodeMatrix& matrix, const Vector& field) {
  Vector product = Vector::Zero(field.size());
  for (Eigen::Index b = 0; b < matrix.outerSize(); ++b) {
    Vec3 sum = Vec3::Zero();  // symmetric: column b is row b
    for (NodeMatrix::InnerIterator it(matrix, b); it; ++it)
      sum += it.value() * field.segment<3>(3 * it.index());
    product.segment<3>(3 * b) = sum;
  }
  return product;
}

void check_mesh(const HexMesh& mesh, const std::string& source) {
  if (mesh.elements.empty() || mesh.nodes.empty())
    throw InputError(
        fmt::format("{}: the mesh has no elements; expected 8-node hexahedra", source));
  for (size_t a = 0; a < mesh.nodes.size(); ++a)
    if (!mesh.nodes[a].allFinite())
      throw InputError(fmt::format("{}: node {} has a position that is not finite", source, a));
  for (size_t e = 0; e < mesh.elements.size(); ++e)
    for (int node : mesh.elements[e])
      if (node < 0 || node >= int(mesh.nodes.size()))
        throw InputError(fmt::format("{}: element {} names node {}; the mesh has nodes 0 to {}",
                                     source, e, node, mesh.nodes.size() - 1));
  Vec3 low = mesh.nodes[0], high = low;
  for (const auto& x : mesh.nodes) low = low.cwiseMin(x), high = high.cwiseMax(x);
  const double length = (high - low).maxCoeff();
  if (length < 0.005 || length > 1.0)
    throw InputError(
        fmt::format("{}: the mesh is {:.4g} mm long; a tongue has 10 to 200 mm. Wrong units? "
                    "Expected metres",
                    source, length * 1e3));
  const Positions x = rest_positions(mesh);
  for (size_t e = 0; e < mesh.elements.size(); ++e)
    for (const auto& xi : hex8::gauss_points()) {
      const double j = jacobian_at(mesh, x, int(e), xi);
      if (j <= 0)
        throw InputError(fmt::format(
            "{}: element {} is inverted (Jacobian {:.3g} mm^3 at an integration point); expected "
            "nodes 0-3 of one face in cyclic order and 4-7 above them",
            source, e, j * 1e9));
    }
}

}  // namespace genio
