#pragma once
// Which further posture would tell two accounts of the same data apart, by simulation.

#include <map>
#include <string>
#include <vector>

#include "discrepancy/conditions/observations.hpp"
#include "inverse/target/head_pose.hpp"

namespace genio {

/// One account of the data: a tongue, and how its data would be laid.
struct PosedModel {
  ModelDescription model;
  HeadPose pose;
};

/// A posture nobody measured yet.
struct Experiment {
  std::map<std::string, double> forces;  ///< of both sides together [N]
  double pitch = 0;                      ///< head tilted backwards [deg]
  double log_odds = 0;  ///< expected of its shape for one account against the other
  std::string label() const;
};

/// The tongue at rest, single muscles and, where gravity plays a part in either account, rest and
/// the best of these lying on the back or on the face: those whose shapes under both accounts
/// differ most, in units of the noise, after the posture's own forces did what they can to make up
/// for it; the best first. Measured as the observations' first condition is. `log_odds` is half the
/// squared difference, what a likelihood ratio brings on average. Postures that have no equilibrium
/// are left out.
std::vector<Experiment> experiments(const PosedModel& one, const PosedModel& other,
                                    const Observations& observations, size_t most = 5);

}  // namespace genio
