#include "inverse/prior/terms/symmetry.hpp"

#include "inverse/prior/base/read_normal.hpp"

namespace genio {

void SymmetryTerm::add_rows(const std::vector<Unknown>& unknowns, PriorRows& rows) const {
  if (!symmetry_sd) return;
  need_positive(*symmetry_sd, "symmetry");
  const auto n = Eigen::Index(unknowns.size());
  const auto other = other_sides(unknowns);
  for (Eigen::Index i = 0; i < n; ++i)
    if (const Eigen::Index j = other[size_t(i)]; j >= 0 && j < i)
      rows.add(Vector::Unit(n, i) - Vector::Unit(n, j), 0, *symmetry_sd);
}

SymmetryTerm SymmetryTerm::read(const TomlReader& file) {
  if (!file.root().get("symmetry_sd")) return {};
  return {positive(file, file.root(), "symmetry_sd", 0)};
}

}  // namespace genio
