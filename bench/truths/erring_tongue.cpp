#include "bench/truths/erring_tongue.hpp"

namespace genio::bench {

std::optional<Positions> ErringTongue::shape(const std::map<std::string, double>& forces) {
  Parameters p = default_parameters(solved());
  for (const auto& [name, newtons] : forces)
    set_command(solved(), name, mirror_ ? newtons / 2 : newtons, p);
  const Equilibrium e = solve_equilibrium(solved(), p, solved().rest, workspace_);
  if (!e) return {};
  return mirror_ ? Positions(mirror_->whole(e.x)) : e.x;
}

}  // namespace genio::bench
