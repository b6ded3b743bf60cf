#include "inverse/shape/believed.hpp"

#include <fmt/format.h>

#include <cmath>

#include "inverse/posterior/distributions.hpp"
#include "inverse/posterior/posterior.hpp"

namespace genio {

BeliefTest test_beliefs(const std::vector<Unknown>& unknowns, const PriorTerms& prior,
                        const Vector& z) {
  BeliefTest test;
  const Vector off = prior.rows * z - prior.values;
  double chi2 = 0;
  int count = 0;
  for (Eigen::Index r = 0; r < prior.rows.rows(); ++r) {
    const Unknown* about = nullptr;
    bool of_muscles = false;
    for (Eigen::Index i = 0; i < z.size(); ++i) {
      if (prior.rows(r, i) == 0) continue;
      const Unknown& u = unknowns[size_t(i)];
      if (u.kind == Unknown::Kind::muscle) of_muscles = true;
      else about = &u;
    }
    if (!about || of_muscles) continue;
    chi2 += off[r] * off[r], ++count;
    if (std::abs(off[r]) >= test.worst_sds) test.worst = about, test.worst_sds = std::abs(off[r]);
  }
  if (count > 0) test.tail = chi_square_tail(chi2, count);
  return test;
}

void doubt_unbelievable(const std::vector<Unknown>& unknowns, const PriorTerms& prior,
                        const Vector& z, Answer& answer) {
  const BeliefTest test = test_beliefs(unknowns, prior, z);
  if (answer.verdict != Verdict::explained || test.tail >= test_level) return;
  answer.verdict = Verdict::mismatch;
  answer.message = fmt::format(
      "the shape is met only with {} {:.1f} standard deviations from what is believed (p = {:.1g})",
      test.worst->name, test.worst_sds, test.tail);
}

}  // namespace genio
