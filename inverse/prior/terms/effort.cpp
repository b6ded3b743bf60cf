#include "inverse/prior/terms/effort.hpp"

#include "inverse/prior/base/read_normal.hpp"

namespace genio {

void EffortTerm::add_rows(const std::vector<Unknown>& unknowns, PriorRows& rows) const {
  need_positive(effort_sd, "effort");
  for (size_t i = 0; i < unknowns.size(); ++i)
    if (unknowns[i].kind == Unknown::Kind::muscle && !rows.has(Eigen::Index(i)))
      rows.add_effort(Eigen::Index(i), effort_sd, muscles_rest);
}

EffortTerm EffortTerm::read(const TomlReader& file) {
  EffortTerm term;
  term.effort_sd = positive(file, file.root(), "effort_sd", term.effort_sd);
  if (const auto* node = file.root().get("muscles_rest"))
    term.muscles_rest = file.truth(*node, "muscles_rest");
  return term;
}

}  // namespace genio
