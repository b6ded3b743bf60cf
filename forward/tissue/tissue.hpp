#pragma once
// Nearly incompressible Yeoh tissue, four elements at a time: the kernels behind every effect that
// changes what the tissue is made of.

#include <array>

#include "forward/algebra/stiffness.hpp"
#include "forward/geometry/element_batches.hpp"
#include "forward/tissue/yeoh.hpp"

namespace genio {

/// Deformation of a batch's elements at all Gauss points.
struct BatchShape {
  using Lane = lanes::Lane;
  Lane f[8][3][3];          ///< deformation gradient F at Gauss point q
  Lane inverse_t[8][3][3];  ///< F^-T
  Lane j[8];                ///< det F
  Lane j23[8];              ///< J^(-2/3)
  Lane invariant[8];        ///< I = J^(-2/3) tr(F^T F)
  Lane volume;              ///< sum_q w_q J_q [m^3]
};

/// What a batch is made of: a law at each Gauss point and a bulk modulus an element [Pa].
struct BatchTissue {
  std::array<Yeoh<lanes::Lane>, 8> law;
  lanes::Lane kappa;

  static BatchTissue uniform(double a10, double a20, double a30, double kappa);
};

/// Fills `shape`; false when an element is turned inside out.
bool deform(const ElementBatch& batch, const Positions& x, BatchShape& shape);

/// sum_e [ sum_q w_q W(I_q) + kappa/2 V_e (v_e/V_e - 1)^2 ]: the law acts on the isochoric part of
/// F at the 8 Gauss points, the volume change on the element's mean, so nearly incompressible
/// tissue does not lock (Q1-P0; Nagtegaal et al. 1974, Simo, Taylor & Pister 1985, pressure
/// condensed) [J].
double batch_energy(const ElementBatch& batch, const BatchShape& shape, const BatchTissue& tissue);

/// Adds minus its derivative [N].
void add_batch_force(const ElementBatch& batch, const BatchShape& shape, const BatchTissue& tissue,
                     Forces& force);

/// Mean pressure kappa (v/V - 1) of each element [Pa].
inline lanes::Lane batch_pressure(const ElementBatch& batch, lanes::Lane volume,
                                  const BatchTissue& tissue) {
  return tissue.kappa * (volume / batch.volume - 1.0);
}

/// Adds its second derivative, with `pressure` in the geometric part [N/m].
void add_batch_stiffness(const ElementBatch& batch, const BatchShape& shape,
                         const BatchTissue& tissue, lanes::Lane pressure, Stiffness& k);

/// Adds the product of that stiffness, at the pressure of the shape, with the nodal field `v`.
void add_batch_stiffness_product(const ElementBatch& batch, const BatchShape& shape,
                                 const BatchTissue& tissue, const Vector& v, Forces& product);

}  // namespace genio
