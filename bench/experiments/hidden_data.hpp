#pragma once
// Data sets in which an effect is hidden, written as a user would have them.

#include "bench/experiments/hidden_change.hpp"
#include "bench/problems/benchmark.hpp"

namespace genio::bench {

/// Fine shapes of the truths in which nothing is hidden, by seed: every draw of noise is of these.
using KnownShapes = std::map<unsigned, std::vector<Positions>>;

struct HiddenCase {
  std::string name;                  ///< of its folder
  std::vector<std::string> effects;  ///< none: nothing is hidden
  double strength = 1;               ///< excess over the noise after the forces were refitted
  bool forces_known = true;          ///< to 10 %
  bool surface = false;              ///< points of the 3D surface, not three curves
  unsigned seed = 1, noise_seed = 1;

  int fitted = 8, heldout = 4;
  double noise = 0.4e-3, correlation = 8e-3;  ///< [m]
};

/// Makes the data set: FOLDER/model, FOLDER/observations.toml and its targets, and what is hidden
/// in `answer` (a file beside the folder, which the workflow never opens). The truth is the tongue
/// refined by eight with fibres turned by 5 degrees. Returns what the answer says, or why there is
/// none (`failed`: strength out of reach among four draws of postures, no equilibrium). `known` is
/// looked up and added to.
Json make_hidden_data(const ModelDescription& tongue, const HiddenCase& what,
                      const std::string& folder, const std::string& answer, KnownShapes& known);

}  // namespace genio::bench
