#pragma once
// The mesh of an indented block: a quarter, as it and its load are symmetric.

#include <vector>

#include "forward/algebra/supports.hpp"
#include "forward/geometry/mesh.hpp"
#include "speaker/indentation/experiment.hpp"

namespace genio {

/// How fine the block is meshed.
struct BlockGrid {
  int core = 3;         ///< cells along a side of the square about the axis
  double edge = 0.08;   ///< of the cells at the edge of the contact, over its radius
  double growth = 1.2;  ///< of cells from one to the next, away from the contact
};

/// The quarter x >= 0, y >= 0 of a block whose bottom lies in z = 0. Rings about the axis become
/// the square outline of the block outwards; cells are small at the edge of the contact and grow
/// away from it. Polygons stand for circles of their area.
struct IndentedBlock {
  HexMesh mesh;
  std::vector<Support> supports;  ///< bottom fixed, planes of symmetry free in themselves
  std::vector<Quad> top;          ///< faces that may touch the indenter
  std::vector<bool> pressed;      ///< of each of them: within the indenter's radius at rest
  std::vector<char> mucosa;       ///< of each element: 1 in the top layer
  int centre = 0;                 ///< node of the top on the axis
};

/// `contact`: radius that the cells are made for [m], the indenter's or, of a sphere, of what
/// touches at the greatest depth.
IndentedBlock indented_block(const IndentationExperiment& experiment, double contact,
                             const BlockGrid& grid);

}  // namespace genio
