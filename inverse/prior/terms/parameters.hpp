#pragma once
#include <limits>
#include <map>

#include "inverse/prior/base/prior_term.hpp"

namespace genio {

/// Of a parameter, cut off at bounds of its own within the parameter's.
struct ParameterPrior : Normal {
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
  bool ratio = false;  ///< sd is of the parameter's logarithm
};

/// Parameters of effects that are estimated along: "jaw_opening.angle", in their own unit.
struct ParametersTerm {
  std::map<std::string, ParameterPrior> parameters;

  /// Throws InputError for a name that the model has not, or a mean out of bounds, naming it.
  std::vector<Unknown> unknowns(const Model& model) const;
  void add_rows(const std::vector<Unknown>& unknowns, PriorRows& rows) const;
  std::vector<std::string> names() const { return names_in(parameters); }
  /// A parameter has one value, whatever part of the tongue it acts on.
  ParametersTerm half() const { return *this; }
  static std::vector<std::string> keys() { return {"parameter"}; }
  static ParametersTerm read(const TomlReader& file);
};

}  // namespace genio
