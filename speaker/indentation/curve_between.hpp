#pragma once
#include <vector>

#include "forward/base/types.hpp"
#include "speaker/indentation/experiment.hpp"

namespace genio {

/// Forces at many depths from those of a few equilibria. What is interpolated, by a polynomial
/// through Chebyshev's points, is force over depth^m, with m = 1, or 1.5 under a sphere, which
/// varies little. It is linear in the forces at the nodes: so it gives derivatives as well.
struct CurveBetween {
  /// `depths`: rising [m]. Where few of them differ, each is a node.
  CurveBetween(const Vector& depths, Indenter indenter);

  std::vector<double> nodes;  ///< rising depths to solve [m]
  Matrix weights;             ///< forces at the depths = weights times forces at the nodes
};

}  // namespace genio
