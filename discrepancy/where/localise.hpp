#pragma once
// Where, in which conditions and in which direction data and shapes disagree beyond noise.

#include "discrepancy/candidates/score.hpp"
#include "discrepancy/conditions/joint_fit.hpp"

namespace genio {

/// One measured point of one condition.
struct MapPoint {
  size_t condition;  ///< index into the observations
  Vec3 place;        ///< on the model's surface [m]
  double distance;   ///< along the surface's normal, positive where the data lie outside [m]
  double z;          ///< of the mean about it, over its standard deviation where nothing is missing
  bool beyond;       ///< beyond noise, with the false-discovery rate of the map
  std::string region;
};

/// Neighbouring points beyond noise on one side, of one condition.
struct MapPatch {
  size_t condition;
  std::string region;
  double mean = 0;  ///< distance [m], signed
  int points = 0;
};

struct ResidualMap {
  std::vector<MapPoint> points;
  std::vector<MapPatch> patches;  ///< the largest first
  double false_discovery_rate = 0;
};

/// The signed map of a fit's residuals. Each point's test is of the mean about it over `reach` [m],
/// by its covariance after the fit (noise correlated along contours, fibres, mesh); Benjamini &
/// Hochberg (1995) hold the rate of false discoveries over all points, whose positive correlation
/// their bound allows (Benjamini & Yekutieli 2001).
ResidualMap localise(const ConditionSet& set, const JointFit& fit, const Matrix& covariance,
                     double false_discovery_rate = 0.05, double reach = 5e-3);

/// A force field that would close what gap the muscles leave.
struct HiddenForce {
  double log_evidence = 0;        ///< gain over no such field
  std::vector<Forces> nodal;      ///< of each condition [N]
  Forces common;                  ///< their mean [N]
  Vec3 centre = Vec3::Zero();     ///< of the common field's magnitude, at rest [m]
  Vec3 resultant = Vec3::Zero();  ///< of the common field [N]
  double total = 0;               ///< sum of the common field's magnitudes [N]
  std::string region;
};

/// The most likely body force field, a Gaussian field of length `length` [m] of which half is
/// common to all conditions, its size by maximal evidence: the smallest that explains the residuals
/// through the stiffness at hand (`influences`) after the free unknowns have done their best.
HiddenForce hidden_force(const ConditionSet& set, const std::vector<Matrix>& influences,
                         const Projection& projection, double length = 0.012);

}  // namespace genio
