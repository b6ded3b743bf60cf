#include "inverse/prior/terms/fixed_forces.hpp"

#include "forward/base/toml_reader.hpp"

namespace genio {

void FixedForcesTerm::add_rows(const std::vector<Unknown>& unknowns, PriorRows& rows) const {
  for (const auto& [name, force] : fixed) {
    const auto which = muscles_named(unknowns, name, "fixed");
    double maximum = 0;
    for (auto i : which) maximum += unknowns[size_t(i)].scale;
    if (!(force >= 0 && force <= maximum * (1 + 1e-12)))
      throw InputError(
          fmt::format("fixed {}: force {} N; expected 0 to {} N", name, force, maximum));
    for (auto i : which) rows.hold(i, std::min(1.0, force / maximum));
  }
}

FixedForcesTerm FixedForcesTerm::half() const {
  FixedForcesTerm term = *this;
  for (auto& [name, force] : term.fixed) force *= 0.5;
  return term;
}

FixedForcesTerm FixedForcesTerm::read(const TomlReader& file) {
  FixedForcesTerm term;
  if (file.root().get("fixed_N"))
    for (const auto& [name, force] : file.table(file.root(), "fixed_N"))
      term.fixed[std::string(name.str())] = file.number(force, std::string(name.str()));
  return term;
}

}  // namespace genio
