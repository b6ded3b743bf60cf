#pragma once
// Shapes the model is known to reach: where to start from when nothing better is known.

#include <functional>
#include <list>

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

/// Asked between solves; true ends the work.
using StopAtlas = std::function<bool()>;

/// Takes a forward solve an entry, two or three a muscle. States without an equilibrium are left
/// out, and what would come after `stop` said so.
Atlas make_atlas(const Model& model, const Prior& prior, bool bilateral, Workspace& ws,
                 const StopAtlas& stop = {});

/// Entries by rising misfit and prior together.
std::vector<const Atlas::Entry*> nearest(const Atlas& atlas, const Comparison& comparison,
                                         const std::vector<Unknown>& unknowns,
                                         const PriorTerms& prior);

/// The atlases of one worker, each made when it is first asked for; the last few are kept.
class AtlasCache {
 public:
  /// Valid until the next call. One that was stopped is not whole, and is made again next time.
  const Atlas& get(const Model& model, const Prior& prior, bool bilateral, Workspace& ws,
                   const StopAtlas& stop = {});

 private:
  std::list<Atlas> atlases_;  // newest first
  Atlas unfinished_;
};

}  // namespace genio
