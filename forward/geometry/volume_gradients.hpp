#pragma once
#include <memory>
#include <vector>

#include "forward/geometry/element_batches.hpp"

namespace genio {

/// Derivatives G = dv_e/dx of the element volumes with respect to nodal positions, at one shape.
/// They keep the batches that they were taken of.
class VolumeGradients {
 public:
  using Batches = std::shared_ptr<const std::vector<ElementBatch>>;

  VolumeGradients() = default;
  VolumeGradients(Batches batches, const Positions& x);

  bool empty() const { return parts_.empty(); }
  Eigen::Index elements() const { return elements_; }
  /// G^T v: what the nodal field v (3 n) does to each element's volume [m^2 times the unit of v].
  Vector rates(const Vector& v) const;
  /// Adds G times the elements' values, a nodal field (3 n).
  void add_times(const Vector& values, Vector& field) const;
  /// Diagonal of G diag(weights) G^T.
  Vector weighted_diagonal(const Vector& weights, Eigen::Index size) const;

 private:
  struct Part {
    std::array<std::array<lanes::Lane, 3>, 8> gradient;  // dv_e/dx_a [m^2]
    const ElementBatch* batch;                           // among batches_
  };
  Batches batches_;
  std::vector<Part> parts_;
  Eigen::Index elements_ = 0;
};

/// What keeps the elements' volumes at a shape: their energies are sum_e c_e/2 (v_e - V_e)^2 with
/// c_e = kappa_e / V_e, their stiffness G diag(c) G^T but for the geometric part.
struct Bulk {
  VolumeGradients gradients;
  Vector stiffness;  ///< c [Pa/m^3]
  Vector excess;     ///< v - V [m^3]
  Vector volume;     ///< V [m^3]

  Vector pressure() const { return stiffness.cwiseProduct(excess); }
};

}  // namespace genio
