#pragma once
#include <map>

#include "inverse/prior/base/prior_term.hpp"

namespace genio {

/// Commands that are known. A name without a side speaks of both sides together.
struct FixedForcesTerm {
  std::map<std::string, double> fixed;  ///< force of a muscle [N]

  void add_rows(const std::vector<Unknown>& unknowns, PriorRows& rows) const;
  std::vector<std::string> names() const { return names_in(fixed); }
  /// Half of each force.
  FixedForcesTerm half() const;
  static std::vector<std::string> keys() { return {"fixed_N"}; }
  static FixedForcesTerm read(const TomlReader& file);
};

}  // namespace genio
