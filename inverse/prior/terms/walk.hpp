#pragma once
#include <optional>

#include "inverse/prior/base/prior_term.hpp"

namespace genio {

/// Activations and parameters walk from frame to frame; head poses do not.
struct WalkTerm {
  /// The frame before and how far activations may have walked since.
  struct Before {
    Vector activations;
    double sd = 0.1;
  };
  std::optional<Before> before;
  /// Random walk of activations in a sequence: sd after one second [s^(-1/2)].
  double smoothness_sd = 1.5;

  void add_rows(const std::vector<Unknown>& unknowns, PriorRows& rows) const;
  std::vector<std::string> names() const { return {}; }
  /// Activations are those of the whole.
  WalkTerm half() const { return *this; }
  static std::vector<std::string> keys() { return {"smoothness_sd"}; }
  static WalkTerm read(const TomlReader& file);
};

}  // namespace genio
