#pragma once
// Long steps that turn and stretch tissue instead of dragging it along straight lines.

#include <memory>
#include <vector>

#include "forward/algebra/cholesky.hpp"
#include "forward/algebra/supports.hpp"
#include "forward/geometry/element_batches.hpp"

namespace genio {

/// A linear step that turns tissue by a large angle swells it, and nearly incompressible tissue
/// answers with a huge pressure. Here the deformation gradient F of each Gauss point follows
/// exp(L) F with L the step's velocity gradient, whose volume is right where L has no trace; the
/// shape whose gradients come nearest to these is found by a Poisson problem on the rest mesh (the
/// idea of rotation-strain coordinates, Huang et al. 2011, as an update of any shape). Supported
/// nodes move along the straight step.
class CurvedStep {
 public:
  CurvedStep(const HexMesh& mesh, const std::vector<Support>& supports);

  /// Root mean square of the velocity gradient of `step` at x over the tissue: about the strain and
  /// rotation it makes.
  double size(const Positions& x, const Vector& step) const;
  /// The shape after the nodal displacements `step` from x; x + step to first order.
  Positions operator()(const Positions& x, const Vector& step) const;

 private:
  std::vector<ElementBatch> batches_;
  std::vector<int> free_;  // index among the unknown nodes; -1: supported
  std::unique_ptr<Cholesky> poisson_;
  Eigen::SparseMatrix<double> boundary_;  // couplings of unknown nodes to all nodes
  int unknowns_ = 0;
};

}  // namespace genio
