#pragma once
// What a term of the prior is. Each is a pair of files in inverse/prior/terms; prior.hpp lists
// them.

#include <concepts>
#include <string>
#include <vector>

#include "inverse/prior/base/prior_rows.hpp"

namespace genio {

class TomlReader;

/// A term is a small struct whose fields are what people fill in. It says
/// - which rows it adds to |A z - b|^2 and which unknowns it holds, checking its own values;
/// - which muscles and parameters it names: one side's name keeps an inversion on the whole tongue;
/// - what it is for the right half of a symmetric tongue, whose forces are half of the whole's and
///   whose activations are the same;
/// - which keys it has in a prior file, and how it is read from there.
template <class Term>
concept PriorTerm = std::copyable<Term> &&
    requires(const Term term, const std::vector<Unknown>& unknowns, PriorRows& rows,
             const TomlReader& file) {
  term.add_rows(unknowns, rows);
  { term.names() } -> std::same_as<std::vector<std::string>>;
  { term.half() } -> std::same_as<Term>;
  { Term::keys() } -> std::same_as<std::vector<std::string>>;
  { Term::read(file) } -> std::same_as<Term>;
};

/// A term that has unknowns estimated along with the muscles.
template <class Term>
concept BringsUnknowns = requires(const Term term, const Model& model) {
  { term.unknowns(model) } -> std::same_as<std::vector<Unknown>>;
};

/// The keys of a map.
template <class Map>
std::vector<std::string> names_in(const Map& map) {
  std::vector<std::string> result;
  for (const auto& [name, value] : map) result.push_back(name);
  return result;
}

}  // namespace genio
