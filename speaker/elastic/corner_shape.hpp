#pragma once
// The shape of an element at its corners, and an energy that no corner can be folded against.

#include <array>
#include <vector>

#include "forward/geometry/mesh.hpp"

namespace genio {

/// The edges of an element that meet at corner `c`, as columns along its three local axes [m].
template <class Position>
Mat3 corner_edges(const Position& position, int c);

/// Which node lies at either end of the edge along local axis `k` at corner `c`.
struct EdgeEnds {
  int low, high;
};
EdgeEnds corner_edge(int c, int k);

/// Energy of a corner's deformation F and its derivatives: the symmetric Dirichlet energy
/// |F|^2 + |F^-1|^2 - 6, which is 0 for rotations and grows without bound where F loses a dimension
/// (Smith and Schaefer 2015). It couples no directions, so that stretching in one does not narrow
/// another.
struct CornerEnergy {
  double value;
  Mat3 gradient;                    ///< by F
  std::array<Mat3, 9> direction;    ///< eigenvectors of the Hessian by F
  std::array<double, 9> stiffness;  ///< eigenvalues, negative ones as 0 (Smith et al. 2019)
};

/// The value alone; infinite where det F <= 0.
double corner_energy(const Mat3& f);
CornerEnergy corner_energy_with_derivatives(const Mat3& f);

template <class Position>
Mat3 corner_edges(const Position& position, int c) {
  Mat3 e;
  for (int k = 0; k < 3; ++k) {
    const EdgeEnds ends = corner_edge(c, k);
    e.col(k) = position(ends.high) - position(ends.low);
  }
  return e;
}

}  // namespace genio
