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
/// out.
class AtlasMaker {
 public:
  AtlasMaker(const Model& model, const Prior& prior, bool bilateral);

  /// True for an atlas of these unknowns within the same bounds.
  bool is_for(const std::vector<Unknown>& unknowns, const PriorTerms& terms) const;
  /// Goes on until all entries are there, or `stop` says so after some; true once all are there.
  bool go_on(const Model& model, Workspace& ws, const StopAtlas& stop = {});
  const Atlas& atlas() const { return atlas_; }

 private:
  bool add(const Model& model, const Vector& z, const Positions& start, Workspace& ws);

  std::vector<Unknown> unknowns_;
  Vector rest_;
  struct Single {
    Eigen::Index muscle;
    size_t level;
  };
  std::vector<Single> left_;  ///< that are to come, last first
  Atlas atlas_;
};

Atlas make_atlas(const Model& model, const Prior& prior, bool bilateral, Workspace& ws);

/// Entries by rising misfit and prior together.
std::vector<const Atlas::Entry*> nearest(const Atlas& atlas, const Comparison& comparison,
                                         const std::vector<Unknown>& unknowns,
                                         const PriorTerms& prior);

/// The atlases of one worker, each made when it is first asked for; the last few are kept. A head
/// pose, which bends no tongue, takes no new one.
class AtlasCache {
 public:
  /// Valid until the next call. One that was stopped holds what was made so far, and is gone on
  /// with when it is asked for again.
  const Atlas& get(const Model& model, const Prior& prior, bool bilateral, Workspace& ws,
                   const StopAtlas& stop = {});

 private:
  std::list<AtlasMaker> makers_;  // newest first
  std::optional<Atlas> posed_;    // the same as one of them, with a head pose
  const AtlasMaker* posed_of_ = nullptr;
};

}  // namespace genio
