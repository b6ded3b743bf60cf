#pragma once
#include <optional>

#include "inverse/prior/base/prior_term.hpp"

namespace genio {

/// The sides of a muscle do the same, where they are unknowns of their own.
struct SymmetryTerm {
  std::optional<double> symmetry_sd;  ///< of left minus right activation

  void add_rows(const std::vector<Unknown>& unknowns, PriorRows& rows) const;
  std::vector<std::string> names() const { return {}; }
  /// Left and right are one unknown there: no row is added.
  SymmetryTerm half() const { return *this; }
  static std::vector<std::string> keys() { return {"symmetry_sd"}; }
  static SymmetryTerm read(const TomlReader& file);
};

}  // namespace genio
