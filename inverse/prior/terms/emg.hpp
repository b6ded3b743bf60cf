#pragma once
#include <map>

#include "inverse/prior/base/prior_term.hpp"

namespace genio {

/// Measured activations. A muscle is named with or without its side; "GGP" speaks of both.
struct EmgTerm {
  std::map<std::string, Normal> emg;  ///< activation of a muscle

  /// Reads a table with the header line `muscle,mean,sd` (activations, 0 to 1). Throws InputError
  /// naming file, line and field.
  static EmgTerm read_table(const std::string& path);

  void add_rows(const std::vector<Unknown>& unknowns, PriorRows& rows) const;
  std::vector<std::string> names() const { return names_in(emg); }
  EmgTerm half() const { return *this; }
  static std::vector<std::string> keys() { return {"emg"}; }
  static EmgTerm read(const TomlReader& file);
};

}  // namespace genio
