#pragma once
// Effects by name, from what a model file says of them.

#include "forward/effects/effect.hpp"
#include "forward/model_file.hpp"
#include "forward/settings.hpp"

namespace genio {

/// What effects are made from: the description with the muscles' segments, and what several need.
struct Anatomy {
  const ModelDescription& description;
  const std::string& source;      ///< named in errors
  std::vector<Muscle> muscles;    ///< with segments
  std::vector<Support> supports;  ///< as the effects present want them
  NodeMatrix mass;                ///< of the tissue
};

/// The supports of a model with these effects: opening jaws and mobile hyoids are unknowns.
std::vector<Support> supports_for(const ModelDescription& description);

/// A place where an effect may be, and the table that puts it there.
struct Place {
  std::string name;
  EffectTable table;
};

/// The places of an effect that needs one; a nameless one for others.
std::vector<Place> places_of(const std::string& effect, const ModelDescription& description);

/// Makes the effect `name` from its table. Throws InputError naming what is wrong.
std::shared_ptr<const Effect> make_effect(const std::string& name, const EffectTable& table,
                                          const Anatomy& anatomy);

/// A node that moves by itself: free, or free within the plane that half a tongue ends at.
bool moves_freely(Support support);
/// Boundary faces, without those of the plane that half a tongue ends at.
std::vector<Quad> outer_faces(const HexMesh& mesh, const std::vector<Support>& supports);
/// Faces of the tongue's own surface: outer faces without a supported node.
std::vector<Quad> free_faces(const HexMesh& mesh, const std::vector<Support>& supports);

}  // namespace genio
