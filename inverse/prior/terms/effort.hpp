#pragma once
#include "inverse/prior/base/prior_term.hpp"

namespace genio {

/// Activations are small: normal about 0, for every muscle of which no term before spoke alone.
/// That is what the best fit is sought under. What is said beyond it also knows that such a muscle
/// may rest, see acting.hpp.
struct EffortTerm {
  double effort_sd = 0.12;
  bool muscles_rest = true;  ///< false: every muscle acts a little, by effort alone

  void add_rows(const std::vector<Unknown>& unknowns, PriorRows& rows) const;
  std::vector<std::string> names() const { return {}; }
  EffortTerm half() const { return *this; }
  static std::vector<std::string> keys() { return {"effort_sd", "muscles_rest"}; }
  static EffortTerm read(const TomlReader& file);
};

}  // namespace genio
