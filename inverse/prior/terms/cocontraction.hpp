#pragma once
#include <optional>

#include "inverse/prior/base/prior_term.hpp"

namespace genio {

/// How much is active on the whole.
struct CocontractionTerm {
  std::optional<Normal> cocontraction;  ///< of the mean over all activations

  void add_rows(const std::vector<Unknown>& unknowns, PriorRows& rows) const;
  std::vector<std::string> names() const { return {}; }
  CocontractionTerm half() const { return *this; }
  static std::vector<std::string> keys() { return {"cocontraction"}; }
  static CocontractionTerm read(const TomlReader& file);
};

}  // namespace genio
