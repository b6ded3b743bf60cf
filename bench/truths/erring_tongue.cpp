#include "bench/truths/erring_tongue.hpp"

namespace genio::bench {

std::unique_ptr<ErringTongue> erring_tongue(const ModelDescription& model, ModelFault fault,
                                            unsigned seed) {
  constexpr unsigned patience = 20;
  for (unsigned k = 0;; ++k) try {
      return std::make_unique<ErringTongue>(erring_truth(model, fault, seed + k), to_string(fault));
    } catch (const InputError&) {
      if (k + 1 == patience) throw;
    }
}

std::optional<Positions> ErringTongue::shape(const std::map<std::string, double>& forces) {
  Parameters p = default_parameters(solved());
  for (const auto& [name, newtons] : forces)
    set_command(solved(), name, mirror_ ? newtons / 2 : newtons, p);
  const Equilibrium e = solve_equilibrium(solved(), p, solved().rest, workspace_);
  if (!e) return {};
  return mirror_ ? Positions(mirror_->whole(e.x)) : e.x;
}

}  // namespace genio::bench
