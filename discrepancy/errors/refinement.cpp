#include "discrepancy/errors/refinement.hpp"

#include "forward/anatomy/refine.hpp"
#include "forward/anatomy/refined_model.hpp"
#include "forward/model/build_model.hpp"
#include "forward/model/mirror.hpp"
#include "inverse/target/comparison.hpp"
#include "inverse/target/head_pose.hpp"

namespace genio {
namespace {

// With an open jaw 5e-3 left contact half solved and cost the true effect 40 log odds; 1e-3 gave
// the log odds of 1e-6 to 0.1.
constexpr double tolerance = 5e-4;
constexpr double nearby = 1e-3;  // of any node, between shapes of one correction [m]

/// Muscle forces of the condition by name, those of left and right evened out where `even`. All
/// else is as the description has it, whose changes of one side half a tongue leaves out.
Parameters evened(const Model& to, const Model& from, const Parameters& p, bool even) {
  Parameters q = default_parameters(to);
  for (Eigen::Index k = 0; k < q.size(); ++k) {
    if (!to.parameters[size_t(k)].is_command) continue;
    const std::string name = to.parameters[size_t(k)].name.key, both = bilateral_name(name);
    double sum = 0;
    int count = 0;
    for (size_t i = 0; i < from.parameters.size(); ++i) {
      if (!from.parameters[i].is_command) continue;
      const std::string& other = from.parameters[i].name.key;
      if (other == name || (even && bilateral_name(other) == both))
        sum += p[Eigen::Index(i)], ++count;
    }
    if (count > 0) q[k] = sum / count;
  }
  return q;
}

/// Those of the half: an unpaired muscle keeps half of its force.
Parameters halved(const Model& half, const Model& whole, const Parameters& p) {
  Parameters q = default_parameters(half);
  for (Eigen::Index k = 0; k < q.size(); ++k) {
    const ParameterSlot& slot = half.parameters[size_t(k)];
    const bool unpaired = slot.is_command && bilateral_name(slot.name.key) == slot.name.key;
    q[k] = (unpaired ? 0.5 : 1.0) * p[parameter_index(whole, slot.name.text())];
  }
  return q;
}

ModelDescription geometry(ModelDescription d) {
  std::erase_if(d.effects, [](const auto& effect) {
    return effect.first != "elasticity" && effect.first != "anatomy";
  });
  d.muscles.clear();
  for (AnatomyMode& mode : d.modes) mode.fixed_points.clear();
  return d;
}

/// Node of `part` that lies where each node of `whole`, or its mirror image, does.
std::vector<int> nodes_of(const HexMesh& part, const HexMesh& whole) {
  std::map<std::array<long long, 3>, int> at;
  for (size_t a = 0; a < part.nodes.size(); ++a) at[place_cell(part.nodes[a])] = int(a);
  std::vector<int> result;
  for (const Vec3& x : whole.nodes)
    result.push_back(at.at(place_cell({x[0], std::abs(x[1]), x[2]})));
  return result;
}

}  // namespace

Refinement::Tongues::Tongues(const ModelDescription& d)
    : coarse(build_model(d, d.name)),
      mirror(mirror_of(coarse)),
      fine(build_model(refined(mirror ? *mirror->half.description : d), d.name + ", refined")),
      whole(build_model(geometry(refined(d)), d.name + ", refined")),
      coarse_workspace(coarse),
      fine_workspace(fine) {
  if (mirror) node = nodes_of(fine.mesh, whole.mesh);
}

Refinement::Refinement(ModelDescription description, const Refinement& before)
    : description_(std::move(description)),
      observations_(before.observations_),
      known_(before.known_) {
  // What half a tongue or a head pose leaves as it was keeps its corrections, too.
  if (description_.effects != before.description_.effects)
    for (auto& [condition, k] : known_) k.fitted.resize(0);
}

bool Refinement::holds(const FittedCondition& c, size_t condition) const {
  const auto k = known_.find(condition);
  return k != known_.end() && k->second.fitted.size() == c.x.size() &&
         k->second.correction.added.size() == c.residuals.values.size() &&
         (k->second.fitted - c.x).cwiseAbs().maxCoeff() < nearby;
}

bool Refinement::holds(const ConditionSet& set, const JointFit& fit) const {
  for (size_t k = 0; k < fit.conditions.size(); ++k)
    if (!holds(fit.conditions[k], set.members()[k])) return false;
  return true;
}

Positions Refinement::nearest_fine(const Tongues& t, const Positions& rest,
                                   const Positions& coarse) const {
  const Positions* nearest = &t.fine.rest;
  double least = (coarse - rest).cwiseAbs().maxCoeff();
  for (const auto& [condition, k] : known_) {
    if (k.fine.size() != t.fine.rest.size()) continue;
    const double far = (k.coarse - coarse).cwiseAbs().maxCoeff();
    if (far < least) least = far, nearest = &k.fine;
  }
  return *nearest;
}

Correction Refinement::correction(const Model& fitted, const FittedCondition& c, size_t condition) {
  const Condition& seen = observations_.conditions[condition];
  auto& made = tongues_[seen.effects];
  if (!made) made = std::make_shared<Tongues>(with_effects(description_, seen.effects));
  Tongues& t = *made;
  SolveOptions options;
  options.tolerance = tolerance;
  const Parameters p = evened(t.coarse, fitted, c.parameters, t.mirror != nullptr);
  const Correction none{Vector::Zero(c.residuals.values.size()), c.residuals};
  const Equilibrium rough = solve_equilibrium(t.coarse, p, c.x, t.coarse_workspace, options);
  if (!rough) return none;
  const Model& near = t.mirror ? t.mirror->half : t.coarse;
  const Positions start = t.mirror ? Positions(t.mirror->right_half(rough.x)) : rough.x;
  const Equilibrium smooth = solve_equilibrium(
      t.fine, t.mirror ? halved(t.fine, t.coarse, p) : evened(t.fine, t.coarse, p, false),
      nearest_fine(t, near.rest, start), t.fine_workspace, options);
  if (!smooth) return none;
  Known& known = known_[condition];
  known.coarse = start, known.fine = smooth.x, known.fitted = c.x;
  Positions x = smooth.x;
  if (t.mirror) {
    x.resize(t.whole.rest.size());
    for (size_t a = 0; a < t.node.size(); ++a) {
      x.segment<3>(3 * Eigen::Index(a)) = node_position(smooth.x, t.node[a]);
      if (t.whole.mesh.nodes[a][1] < 0) x[3 * Eigen::Index(a) + 1] *= -1;
    }
  }
  const HeadPose pose = head_pose(c.unknowns, c.z);
  const Target& target = seen.target;
  // Smooth distances from a curved surface are longer than they are; that goes with the rest.
  known.correction.exact = Comparison(t.whole, target)(x, pose);
  known.correction.added = known.correction.exact.values -
                           Comparison(t.coarse, target, surface_smoothing)(rough.x, pose).values;
  return known.correction;
}

RefinedCorrections Refinement::corrections(const ConditionSet& set, const JointFit& fit) const {
  RefinedCorrections result{{}, *this};
  Refinement& after = result.refinement;
  for (size_t k = 0; k < fit.conditions.size(); ++k) {
    const FittedCondition& c = fit.conditions[k];
    const size_t condition = set.members()[k];
    result.corrections.push_back(after.holds(c, condition)
                                     ? after.known_.at(condition).correction
                                     : after.correction(set.model(k), c, condition));
  }
  return result;
}

}  // namespace genio
