#pragma once
// Which further posture would separate two models of the same data, by simulation.

#include <map>
#include <string>
#include <vector>

#include "discrepancy/conditions/observations.hpp"
#include "inverse/target/head_pose.hpp"

namespace genio {

/// A model of the data, and the head pose that they would be laid with.
struct PosedModel {
  ModelDescription model;
  HeadPose pose;
};

/// A posture nobody measured yet.
struct Experiment {
  std::map<std::string, double> forces;  ///< of both sides together [N]
  double pitch = 0;                      ///< head tilted backwards [deg]
  double log_odds = 0;                   ///< expected of its shape for one model against the other
  /// The same where more is measured of it, see further_measurement(), the most telling one first;
  /// of the best posture alone.
  std::vector<std::pair<std::string, double>> further = {};
  std::string label() const;
};

/// The tongue at rest, single muscles and, where gravity plays a part in either model, rest and
/// the best of these lying on the back or on the face: those whose shapes under both models
/// differ most, in units of the noise, after the posture's own forces did what they can to make up
/// for it; the best first. Measured as the observations' first condition is. `log_odds` is half the
/// squared difference, what a likelihood ratio brings on average. Postures that have no equilibrium
/// are left out. Of the best one `further` says what more slices and sensors would bring.
std::vector<Experiment> experiments(const PosedModel& one, const PosedModel& other,
                                    const Observations& observations, size_t most = 5);

}  // namespace genio
