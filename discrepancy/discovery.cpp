#include "discrepancy/discovery.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace genio {

const char* to_string(Finding finding) {
  switch (finding) {
    case Finding::named:
      return "named";
    case Finding::ambiguous:
      return "ambiguous";
    case Finding::none:
      return "none";
    case Finding::unknown:
      return "unknown";
  }
  return "none";
}

std::string explanation(Finding finding, double p) {
  switch (finding) {
    case Finding::none:
      return fmt::format("what is left is within noise (p = {:.2g})", p);
    case Finding::unknown:
      return fmt::format("a gap beyond noise (p = {:.1g}) that no candidate explains", p);
    case Finding::ambiguous:
      return "these data do not tell the candidates below apart";
    case Finding::named:
      return fmt::format("with it, what is left is within noise (p = {:.2g})", p);
  }
  return "";
}

std::vector<Family> families(const Observations& o, const Round& first) {
  std::vector<Family> result;
  const bool some_known =
      std::any_of(o.conditions.begin(), o.conditions.end(),
                  [](const Condition& c) { return !c.heldout && c.forces.has_value(); });
  if (!some_known)
    result.push_back({"stiffness and force scale",
                      "a tongue so much stiffer under forces so much larger has the same shapes",
                      {"elasticity.a10 and a20 by one factor", "all forces by that factor"}});
  Family absorbed{"absorbed by the forces", "unknown forces make all that these would show", {}};
  for (const Ranked& r : first.candidates)
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

std::vector<NamedEffect> named(const JointFit& fit, const std::vector<Candidate>& found,
                               const std::vector<double>& confidence) {
  std::vector<NamedEffect> result;
  for (size_t i = 0; i < found.size(); ++i) {
    NamedEffect n{found[i].effect, found[i].where, {}, confidence[i]};
    for (const SharedEstimate& e : fit.shared) {
      if (e.name.substr(0, e.name.find('.')) != found[i].effect) continue;
      const std::string key = e.name.substr(e.name.find('.') + 1);
      const bool other = found[i].effect == "weak_muscle" && key != found[i].where;
      if (!other) n.parameters.push_back(e);
    }
    if (found[i].is_switch())
      for (const FreeNumber& s : found[i].strengths)
        n.parameters.push_back({found[i].effect + "." + s.name, s.info.unit,
                                s.info.absent + s.info.typical, 0, 0, s.info.upper});
    result.push_back(std::move(n));
  }
  return result;
}

}  // namespace genio
