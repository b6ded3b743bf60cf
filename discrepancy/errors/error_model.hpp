#pragma once
// How far residuals may be from zero although nothing is missing: noise, fibre directions, mesh.

#include "discrepancy/conditions/joint_fit.hpp"
#include "discrepancy/errors/covariance_root.hpp"
#include "inverse/target/comparison.hpp"

namespace genio {

/// What is believed of a model that lacks nothing.
struct ErrorModel {
  double fibre_turn = 5;           ///< mean angle between true and modelled fibres [deg]
  double fibre_length = 8e-3;      ///< over which that angle stays alike [m]
  double fibres_alike = 0.75;      ///< part of a variance that is alike left and right
  double efficacy_sd = 0.1;        ///< of what a newton of a muscle, or an effect's unit, does
  double tissue_sd = 0.03;         ///< of the logarithm of the tissue's stiffness
  double place_sd = 6e-4;          ///< of a place or size found on the mesh [m]
  double correction_sd = 0.25;     ///< of the mesh's own error, as a part of its correction
  double least_mesh_error = 3e-5;  ///< [m]
  double local_error = 5e-5;       ///< of the mesh within an element, from point to point [m]
  double mesh_length = 0.012;      ///< of the rest of the mesh's error [m]
};

/// Covariance of the noise of one condition's residuals, in units of its standard deviation:
/// n.n' exp(-distance / length) within a contour for residuals across n and n' (each coordinate an
/// Ornstein-Uhlenbeck process along it), and between contours none.
Matrix noise_covariance(const Target& target, const Residuals& residuals, double length);

/// Forces that turned fibres make: rows of `influence` times d nodal force / d displacement u of
/// the fibres in the tissue (rows x 3 n [1/m]). A muscle's force f at x(X + u) works on the tissue
/// there: f' = dT/dx F u along its new direction, and f.(dN/dX u) to the neighbours.
Matrix fibre_influence(const Model& model, const FittedCondition& condition,
                       const Matrix& influence);

/// Covariance of the fibres' displacements along x, y or z between the model's nodes [m^2]: two
/// Gaussian fields, one alike left and right and one of each side's own. Along x as along z. Not to
/// outlive the model.
Covariance fibre_covariance(const Model& model, const ErrorModel& error_model, int axis);

/// Covariance of all residuals, one condition's after another's, from muscles that do more or less
/// for their force than the model has it, in all conditions alike.
Matrix efficacy_covariance(const ConditionSet& set, const JointFit& fit,
                           const std::vector<Matrix>& influences, const ErrorModel& error_model);

/// The covariance of all residuals of a fit, one condition's after another's. `influences`: of each
/// condition, see influence().
Matrix residual_covariance(ConditionSet& set, const JointFit& fit,
                           const std::vector<Matrix>& influences, const Corrections& corrections,
                           const ErrorModel& error_model);

}  // namespace genio
