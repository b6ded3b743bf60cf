#include "inverse/prior/terms/cocontraction.hpp"

#include "inverse/prior/base/read_normal.hpp"

namespace genio {

void CocontractionTerm::add_rows(const std::vector<Unknown>& unknowns, PriorRows& rows) const {
  if (!cocontraction) return;
  need_positive(cocontraction->sd, "cocontraction");
  Vector share = Vector::Zero(Eigen::Index(unknowns.size()));
  for (size_t i = 0; i < unknowns.size(); ++i)
    if (unknowns[i].kind == Unknown::Kind::muscle) share[Eigen::Index(i)] = 1;
  rows.add(share / share.sum(), cocontraction->mean, cocontraction->sd);
}

CocontractionTerm CocontractionTerm::read(const TomlReader& file) {
  const auto* node = file.root().get("cocontraction");
  if (!node) return {};
  return {read_activation(file, *node, "cocontraction")};
}

}  // namespace genio
