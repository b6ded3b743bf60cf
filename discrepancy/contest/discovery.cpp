#include "discrepancy/contest/discovery.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace genio {
const char* to_string(DiscoveryVerdict verdict) {
  switch (verdict) {
    case DiscoveryVerdict::named:
      return "named";
    case DiscoveryVerdict::ambiguous:
      return "ambiguous";
    case DiscoveryVerdict::none:
      return "none";
    case DiscoveryVerdict::unknown:
      return "unknown";
  }
  return "none";
}

std::string message_of(DiscoveryVerdict verdict, double p, double heldout) {
  switch (verdict) {
    case DiscoveryVerdict::none:
      return fmt::format("what is left is within noise (p = {:.2g})", p);
    case DiscoveryVerdict::unknown:
      return fmt::format(
          "a gap beyond noise (p = {:.1g}, {:.1g} in conditions held out) that no candidate "
          "explains",
          p, heldout);
    case DiscoveryVerdict::ambiguous:
      return "these data do not tell the candidates below apart";
    case DiscoveryVerdict::named:
      return fmt::format("with it, what is left is within noise (p = {:.2g})", p);
  }
  return "";
}

std::vector<ConfoundedSet> confounded_sets(const Observations& o, const Round& first) {
  std::vector<ConfoundedSet> result;
  const bool some_known =
      std::any_of(o.conditions.begin(), o.conditions.end(),
                  [](const Condition& c) { return !c.heldout && c.forces.has_value(); });
  if (!some_known)
    result.push_back({"stiffness and force scale",
                      "a tongue so much stiffer under forces so much larger has the same shapes",
                      {"elasticity.a10 and a20 by one factor", "all forces by that factor"}});
  ConfoundedSet absorbed{
      "absorbed by the forces", "unknown forces make all that these would show", {}};
  for (const RankedCandidate& r : first.candidates)
    if (r.score.moves && !r.score.visible) absorbed.members.push_back(r.candidate.label());
  if (!absorbed.members.empty()) result.push_back(std::move(absorbed));
  return result;
}

Gap gap_of(const JointFit& fit, double noise) {
  Gap g;
  const Vector r = fit.residuals();
  if (r.size() == 0) return g;
  double square = 0;
  Eigen::Index at = 0;
  for (const auto& c : fit.conditions)
    for (const auto& row : c.residuals.rows) square += std::pow(r[at++] / row.scale, 2);
  g.rms = std::sqrt(square / double(r.size()));
  g.excess = std::sqrt(std::max(0.0, g.rms * g.rms - noise * noise));
  return g;
}

}  // namespace genio
