#include "inverse/prior/terms/effort.hpp"

#include "inverse/prior/base/read_normal.hpp"

namespace genio {

void EffortTerm::add_rows(const std::vector<Unknown>& unknowns, PriorRows& rows) const {
  need_positive(effort_sd, "effort");
  for (Eigen::Index i = 0; i < Eigen::Index(unknowns.size()); ++i) {
    if (unknowns[size_t(i)].kind != Unknown::Kind::muscle) continue;
    if (!rows.has(i)) rows.add_effort(i, effort_sd);
    if (muscles_rest) rows.may_rest(i, effort_sd);
  }
}

EffortTerm EffortTerm::read(const TomlReader& file) {
  EffortTerm term;
  term.effort_sd = positive(file, file.root(), "effort_sd", term.effort_sd);
  if (const auto* node = file.root().get("muscles_rest"))
    term.muscles_rest = file.truth(*node, "muscles_rest");
  return term;
}

}  // namespace genio
