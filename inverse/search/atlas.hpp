#pragma once
// Shapes the model is known to reach: where to start from when nothing better is known.

#include "inverse/shape/infer.hpp"
#include "inverse/target/comparison.hpp"

namespace genio {

/// Equilibria of each command alone at a few activations, and rest. Made once for a model, the
/// commands and the other unknowns at what the prior expects; then const.
struct Atlas {
  struct Entry {
    Vector unknowns;    ///< z
    Positions shape;    ///< [m]
    Matrix by_unknown;  ///< its derivative, 3 n x unknowns
  };
  std::vector<Entry> entries;
  std::vector<std::string> names;  ///< of the unknowns it is for
  Vector lower, upper;             ///< their bounds
};

/// Takes a forward solve an entry, two or three a muscle. States without an equilibrium are left
/// out.
Atlas make_atlas(const Model& model, const Prior& prior, bool bilateral, Workspace& ws);

/// Entries by rising misfit and prior together.
std::vector<const Atlas::Entry*> nearest(const Atlas& atlas, const Comparison& comparison,
                                         const std::vector<Unknown>& unknowns,
                                         const PriorTerms& prior);

/// The atlas of one worker, made when it is first asked for and again for other unknowns. A head
/// pose, which bends no tongue, takes no new one.
class AtlasCache {
 public:
  const Atlas& get(const Model& model, const Prior& prior, bool bilateral, Workspace& ws);

 private:
  std::optional<Atlas> atlas_, posed_;  // the same without and with a head pose
};

}  // namespace genio
