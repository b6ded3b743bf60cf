#include "runs/results/answer_view.hpp"

#include "inverse/target/tongue_line.hpp"

namespace genio {

AnswerView view_of(const Model& model, const Target& target, const Answer& a) {
  AnswerView v;
  v.status = to_string(a.status), v.message = a.message, v.verdict = to_string(a.verdict);
  v.muscles = a.muscles, v.others = a.others, v.trade_offs = a.unidentified;
  for (const TradeOff& trade : a.unidentified) v.unidentified.push_back(names(trade));
  v.weight = a.weight, v.alternatives = a.alternatives, v.outliers = a.residuals.outliers;
  v.rms_mm = 1e3 * a.rms, v.max_mm = 1e3 * a.max, v.chi2_per_dof = a.chi2_per_dof;
  v.wall_s = a.wall_s, v.iterations = a.iterations, v.factorizations = a.factorizations;
  for (const auto& p : target.curve) v.measured.push_back(p.position);
  for (const auto& p : target.flesh) v.measured.emplace_back(p.position[0], p.position[2]);
  if (a.shape.size() > 0) v.predicted = TongueLine(model).sample(a.shape, 120);
  return v;
}

}  // namespace genio
