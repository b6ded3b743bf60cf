#pragma once
// Problems of known answer, for tests and for the verification tables.

#include "forward/effects/tissue/elasticity.hpp"
#include "forward/model/model.hpp"

namespace genio::bench {

/// Bare tissue under nodal dead loads of `force` times `weights` (3 n; may be empty).
Model tissue_problem(HexMesh mesh, std::vector<Support> supports, const TissueConstants& constants,
                     Forces weights = {}, double force = 1);

/// Such a model with Rayleigh damping.
Model damped(const Model& undamped, double alpha, double beta);

/// First Piola stress of Elasticity's law in a homogeneous deformation [Pa].
Mat3 first_piola(const Mat3& f, const TissueConstants& constants);

/// Bulk modulus for a Poisson ratio at small strains [Pa]: shear modulus 2 a10.
double bulk_modulus(double a10, double poisson_ratio);

/// Cook's membrane (44 to 16 mm high, 48 mm long, plane strain; shear modulus 801.94 Pa, 62.5 Pa
/// shear at the right end) in n x n elements: rise of its upper right corner [m]. NaN where not
/// solved.
double cook_corner(int n, double poisson_ratio);

}  // namespace genio::bench
