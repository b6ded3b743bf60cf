#pragma once
#include "inverse/prior/base/prior_term.hpp"

namespace genio {

/// Activations are small: normal about 0, for every muscle of which no term before spoke alone.
struct EffortTerm {
  double effort_sd = 0.12;

  void add_rows(const std::vector<Unknown>& unknowns, PriorRows& rows) const;
  std::vector<std::string> names() const { return {}; }
  EffortTerm half() const { return *this; }
  static std::vector<std::string> keys() { return {"effort_sd"}; }
  static EffortTerm read(const TomlReader& file);
};

}  // namespace genio
