#pragma once
// What is said of an unknown, and of a fit.

#include <limits>
#include <string>
#include <vector>

#include "inverse/prior/base/unknowns.hpp"

namespace genio {

enum class Verdict { none, explained, unreachable, mismatch };
const char* to_string(Verdict verdict);

/// What is said of an unknown: a muscle's force in N, both sides together for bilateral commands,
/// or another one in its own unit.
struct Estimate {
  std::string name;
  double best = 0, maximum = 0;
  std::string unit = "N";
  Unknown::Kind kind = Unknown::Kind::muscle;
  /// Probability that it acts at all; NaN where the prior knows no rest, and of what is no muscle.
  double acts = std::numeric_limits<double>::quiet_NaN();
  /// Of the posterior; NaN: not told.
  double median = std::numeric_limits<double>::quiet_NaN(), mean = median;
  double sd = 0;
  /// 90 % interval. Of what may rest it is that of its force if it acts, and 0 unless it surely
  /// acts. The best fit may lie outside.
  double low = 0, high = 0;
  double information_bits = 0;  ///< binary logarithm of the prior's over the posterior's sd
  bool at_lower = false, at_upper = false, fixed = false;
  /// Where a bound presses: how much the objective (half a chi-square) would fall a unit of z
  /// beyond it, the bound's multiplier.
  double multiplier = 0;
};

/// Muscles of which at least one acts, though each alone may rest, and their sum.
struct JointForce {
  std::vector<std::string> names;
  double acts = 0;           ///< probability that one of them does
  double low = 0, high = 0;  ///< 90 % interval of their sum [N]
};

/// What trades for what without the data noticing: a direction in the unknowns, in their own units.
struct Share {
  std::string name;
  double amount;
  bool operator==(const Share&) const = default;
};
using TradeOff = std::vector<Share>;
std::vector<std::string> names(const TradeOff& trade);

}  // namespace genio
