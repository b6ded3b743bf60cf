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

/// Nodal forces that a constant nominal stress P puts on the faces whose nodes all satisfy
/// `on_face` [N].
template <class OnFace>
void add_traction(const HexMesh& mesh, const Mat3& stress, OnFace on_face, Forces& f);

/// Cook's membrane (44 to 16 mm high, 48 mm long, plane strain; shear modulus 801.94 Pa, 62.5 Pa
/// shear at the right end) in n x n elements: rise of its upper right corner [m]. NaN where not
/// solved.
double cook_corner(int n, double poisson_ratio);

/// Manufactured deformation, two shears one after the other, on a cube of n^3 elements whose
/// interior nodes are shaken by `distortion` of their spacing; body forces by the law, exact
/// positions on the boundary: relative L2 error of the displacement. NaN where not solved.
double manufactured_error(int n, double poisson_ratio, double distortion);

/// Hollow sphere (inner radius 10, outer 20 mm) whose inner surface is blown up to `stretch`, in
/// six patches of n x n x layers elements: pressure on it over the exact one of the incompressible
/// law (Green & Zerna 1954; by quadrature). NaN where not solved.
double sphere_pressure_ratio(int n, int layers, double stretch);

}  // namespace genio::bench

#include "bench/problems/traction.hpp"
