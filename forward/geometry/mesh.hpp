#pragma once
// Hexahedral meshes: geometry questions, no mechanics.

#include <Eigen/SparseCore>
#include <array>
#include <string>
#include <vector>

#include "forward/base/types.hpp"

namespace genio {

/// 8-node hexahedra in VTK_HEXAHEDRON order: nodes 0-3 one face in cyclic order, 4-7 above them.
struct HexMesh {
  std::vector<Vec3> nodes;  ///< rest positions [m]
  std::vector<std::array<int, 8>> elements;
};

/// A quadrilateral of the mesh's surface, nodes counter-clockwise seen from outside.
using Quad = std::array<int, 4>;

/// A node this near y = 0 lies in the midsagittal plane [m].
constexpr double on_plane = 1e-6;

/// Rest positions as one vector of 3 n values [m].
Positions rest_positions(const HexMesh& mesh);

/// Jacobian determinants of the trilinear map at the 8 corners [m^3].
std::array<double, 8> corner_jacobians(const HexMesh& mesh, int element);

/// Smallest over largest corner Jacobian of an element; 1 for a parallelepiped, < 0 when folded.
double corner_jacobian_ratio(const HexMesh& mesh, int element);

/// Volume of an element in the shape `x` by 2x2x2 Gauss points, exact for trilinear maps [m^3].
double element_volume(const HexMesh& mesh, const Positions& x, int element);

/// Volume of the whole mesh in the shape `x` [m^3].
double mesh_volume(const HexMesh& mesh, const Positions& x);

/// Faces that belong to one element only.
std::vector<Quad> boundary_quads(const HexMesh& mesh);

/// Surface area that each node stands for [m^2]; zero inside.
std::vector<double> nodal_areas(const HexMesh& mesh, const std::vector<Quad>& quads);

/// A symmetric matrix over nodes, the same for x, y and z.
using NodeMatrix = Eigen::SparseMatrix<double>;

/// Consistent mass matrix of tissue of the given density [kg/m^3]: integrals of N_a N_b [kg].
NodeMatrix tissue_mass(const HexMesh& mesh, double density);

/// Its product with a nodal field (3 n).
Vector multiply(const NodeMatrix& matrix, const Vector& field);

/// Throws InputError naming `source` when the mesh cannot be computed with: no elements, bad node
/// numbers, non-finite positions, an element inverted at an integration point, or a size that no
/// tongue has (which usually means wrong units).
void check_mesh(const HexMesh& mesh, const std::string& source);

}  // namespace genio
