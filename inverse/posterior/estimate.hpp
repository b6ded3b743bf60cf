#pragma once
// What is said of an unknown, and of a fit.

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
  double sd = 0;                ///< of the posterior
  double low = 0, high = 0;     ///< 90 % interval; one-sided where the force is at a bound
  double information_bits = 0;  ///< binary logarithm of the prior's over the posterior's sd
  bool at_lower = false, at_upper = false, fixed = false;
  /// Where a bound presses: how much the objective (half a chi-square) would fall a unit of z
  /// beyond it, the bound's multiplier.
  double multiplier = 0;
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
