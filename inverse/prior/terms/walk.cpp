#include "inverse/prior/terms/walk.hpp"

#include "inverse/prior/base/read_normal.hpp"

namespace genio {

void WalkTerm::add_rows(const std::vector<Unknown>& unknowns, PriorRows& rows) const {
  if (!before) return;
  need_positive(before->sd, "smoothness");
  if (before->activations.size() != Eigen::Index(unknowns.size()))
    throw std::invalid_argument("the frame before has other unknowns");
  for (Eigen::Index i = 0; i < before->activations.size(); ++i)
    if (unknowns[size_t(i)].kind != Unknown::Kind::pose)
      rows.add(i, before->activations[i], before->sd);
}

WalkTerm WalkTerm::read(const TomlReader& file) {
  WalkTerm term;
  term.smoothness_sd = positive(file, file.root(), "smoothness_sd", term.smoothness_sd);
  return term;
}

}  // namespace genio
