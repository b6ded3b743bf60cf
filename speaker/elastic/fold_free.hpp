#pragma once
// Drawing a mesh to where it should lie without folding an element.

#include <array>
#include <vector>

#include "forward/algebra/supports.hpp"
#include "forward/geometry/mesh.hpp"

namespace genio {

/// A place on the mesh, weighted over the nodes of one face or edge, that is drawn somewhere:
/// 1/2 d^T metric d with d the way from `goal`.
struct Pull {
  std::array<int, 4> nodes = {-1, -1, -1, -1};  ///< -1: none
  std::array<double, 4> weights = {0, 0, 0, 0};
  Vec3 goal = Vec3::Zero();    ///< [m]
  Mat3 metric = Mat3::Zero();  ///< [J/m^2]
};

/// The elements' own shapes that cost nothing: inverse of the edges at each corner [1/m].
using CornerShapes = std::vector<std::array<Mat3, 8>>;

/// The shapes of a mesh's corners; a corner that is nearly folded has its element's mean shape in
/// the place of its own, so that it opens. Throws std::invalid_argument where one is folded.
CornerShapes corner_shapes(const HexMesh& mesh);

/// What is minimised.
struct FoldFreeProblem {
  const HexMesh* mesh;          ///< its elements count, not its places
  CornerShapes shapes;          ///< one an element
  std::vector<double> volumes;  ///< weights of the elements [m^3]
  double stiffness = 1;         ///< of a corner's energy [J/m^3]
  /// Cost of corners that are much smaller than the mean of their element's: squares of
  /// max(0, wanted / (smallness) - 1), by volume [J/m^3]; 0: none.
  double quality = 0;
  double wanted = 0.35;
  std::vector<Pull> pulls = {};
  std::vector<Support> supports;  ///< free, fixed or held along axes
};

struct FoldFreeOptions {
  int most_steps = 60;
  double small_step = 2e-6;  ///< ends once no node moves farther [m]
};

struct FoldFreeResult {
  Positions x;
  double energy = 0;
  int steps = 0;
};

/// The energy in the shape `x`; infinite where a corner is folded.
double fold_free_energy(const FoldFreeProblem& problem, const Positions& x);

/// Its gradient by all nodal positions.
Vector fold_free_gradient(const FoldFreeProblem& problem, const Positions& x);

/// Projected Newton steps from `start`, in which no corner may be folded; each lowers the energy,
/// so none ever is. Throws std::invalid_argument where one is at the start.
FoldFreeResult minimise_fold_free(const FoldFreeProblem& problem, const Positions& start,
                                  const FoldFreeOptions& options = {});

}  // namespace genio
