#include "inverse/search/symmetric_route.hpp"

#include <algorithm>
#include <cmath>

namespace genio {
namespace {

bool one_sided(const std::string& name) { return bilateral_name(name) != name; }

}  // namespace

void double_forces(std::vector<Estimate>& unknowns) {
  for (Estimate& c : unknowns) {
    if (c.kind != Unknown::Kind::muscle) continue;
    c.best *= 2, c.maximum *= 2, c.sd *= 2;
    c.low *= 2, c.high *= 2, c.median *= 2, c.mean *= 2;
  }
}

void double_forces(std::vector<JointForce>& joint) {
  for (JointForce& j : joint) j.low *= 2, j.high *= 2;
}

bool fits_half_tongue(const Target& target, const Prior& prior, const InferOptions& options) {
  if (!target.midsagittal() || !options.bilateral.value_or(true) || options.finite_differences)
    return false;
  return std::ranges::none_of(names_in_prior(prior), one_sided);
}

Target half_target(const Mirror& mirror, const Target& target) {
  Target result = target;
  for (FleshPoint& f : result.flesh) {
    for (auto& [node, share] : f.at) {
      // Off the plane y is not what was measured, or it would not be a symmetric problem.
      if (mirror.side[size_t(node)] < 0) f.position[1] = std::nan("");
      node = mirror.node[size_t(node)];
    }
  }
  return result;
}

InferOptions half_options(const Mirror& mirror, const InferOptions& options) {
  InferOptions result = options;
  result.bilateral = true;
  if (options.start_shape) result.start_shape = mirror.right_half(*options.start_shape);
  if (options.start_by_unknown.size() > 0)
    result.start_by_unknown = mirror.right_half(options.start_by_unknown);
  if (options.improved)
    result.improved = [&mirror, tell = options.improved](const Answer& half) {
      tell(whole_answer(mirror, half));
    };
  return result;
}

Answer whole_answer(const Mirror& mirror, Answer answer) {
  double_forces(answer.muscles);
  double_forces(answer.joint);
  for (TradeOff& trade : answer.unidentified)
    for (Share& share : trade)
      for (const Estimate& c : answer.muscles)
        if (c.name == share.name) share.amount *= 2;
  for (Alternative& a : answer.alternatives) {
    double_forces(a.muscles);
    a.shape = mirror.whole(a.shape);
  }
  for (auto& row : answer.residuals.gradient)
    for (auto& [node, slope] : row) node = mirror.right[size_t(node)];
  if (answer.shape.size() > 0) answer.shape = mirror.whole(answer.shape);
  if (answer.shape_by_unknown.size() > 0)
    answer.shape_by_unknown = mirror.whole(answer.shape_by_unknown);
  return answer;
}

}  // namespace genio
