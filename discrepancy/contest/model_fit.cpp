#include "discrepancy/contest/model_fit.hpp"

namespace genio {

bool improves(const JointFit& f, const JointFit& other) {
  return f.converged && f.value < other.value;
}

ModelFit with_residual_test(ModelFit m, const Errors& errors) {
  const Projection projection(m.fit, errors.covariance);
  m.chi_square = projection.chi_square(), m.dof = projection.dof();
  return m;
}

PosedModel posed_model_of(const ModelFit& m) {
  PosedModel posed{with_fitted(m.description, m.fit), {}};
  for (const SharedEstimate& s : m.fit.shared) {
    if (s.kind != Unknown::Kind::pose) continue;
    switch (s.axis) {
      case PoseAxis::x:
        posed.pose.shift[0] = s.value;
        break;
      case PoseAxis::z:
        posed.pose.shift[1] = s.value;
        break;
      case PoseAxis::turn:
        posed.pose.turn = s.value;
        break;
    }
  }
  return posed;
}

ModelDescription with_fitted(ModelDescription d, const JointFit& fit) {
  for (const SharedEstimate& e : fit.shared) {
    if (e.kind == Unknown::Kind::pose) continue;
    EffectTable& table = d.effects[e.name.effect];
    if (table.contains(e.name.key)) table[e.name.key] = e.value;
    else
      for (const char* side : {"_L", "_R"}) table[e.name.key + side] = e.value;
  }
  return d;
}

ModelFit with_heldout_fit(ModelFit m, const FitStart& start, const DataErrors& errors) {
  const Observations& observations = m.set->observations();
  const auto members = heldout_conditions(observations);
  if (members.empty()) return m;
  m.heldout_set =
      std::make_shared<ConditionSet>(with_fitted(m.description, m.fit), observations, members);
  // A head pose that all data were laid with is no parameter of the model, but as little free.
  SharedPrior shared;
  FitOptions options{start};
  shared.head_pose = m.shared.head_pose;
  for (const SharedEstimate& e : m.fit.shared)
    if (e.kind == Unknown::Kind::pose) options.fixed[e.name] = e.value;
  options.shared_start = options.fixed;
  m.heldout = fit(*m.heldout_set, shared, errors.heldout.get(), options);
  return m;
}

}  // namespace genio
