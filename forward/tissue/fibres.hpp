#pragma once
// Muscles as bundles of fibres along mesh nodes, and the share of the force each segment carries.

#include <string>
#include <vector>

#include "forward/base/types.hpp"
#include "forward/geometry/mesh.hpp"

namespace genio {

/// A point of a fibre: a mesh node, or a fixed point outside the mesh (the styloid process).
struct FibrePoint {
  int node = -1;
  Vec3 anchor = Vec3::Zero();  ///< [m], used when node < 0

  Vec3 position(const Positions& x) const {
    return node >= 0 ? Vec3(node_position(x, node)) : anchor;
  }
};

using Fibre = std::vector<FibrePoint>;

/// A muscle cannot shorten to nothing: below this part of its rest length a segment's tension
/// fades. Without that, segments collapse to points, where their direction is undefined.
inline constexpr double shortest_fibre = 0.2;

struct FibreSegment {
  FibrePoint start, end;
  double share = 0;         ///< tension of this segment per newton of command
  double short_length = 0;  ///< below it the tension fades [m]
};

/// One command: a muscle of one side ("GGP_L"), or an unpaired muscle ("SL").
struct Muscle {
  std::string name;
  double max_force = 0;  ///< of this side [N]
  std::vector<Fibre> fibres;
  std::vector<int> elements;           ///< elements the muscle runs through
  std::vector<FibreSegment> segments;  ///< all fibres' segments with their shares
};

/// The segments of fibres, one after another, without shares.
std::vector<FibreSegment> segments_of(const HexMesh& mesh, const std::vector<Fibre>& fibres);

/// Segments of all fibres with shares by the tissue volume each stands for:
/// share_s = V_s / sum over fibres f of max over s in f of V_s, where V_s is the volume of the
/// muscle's elements that contain both ends of the segment or, when there is none, the mean volume
/// of those that contain its first end (the rule of the Grenoble model as carried in ArtiSynth,
/// Stavness et al. 2012). So every fibre's thickest cross-section adds up to the whole force.
std::vector<FibreSegment> share_by_volume(const HexMesh& mesh, const std::vector<Fibre>& fibres,
                                          const std::vector<int>& elements);

/// Length of a fibre in the shape `x` [m].
double fibre_length(const Fibre& fibre, const Positions& x);

/// "GGP_L" -> "GGP"; "SL" -> "SL".
std::string bilateral_name(const std::string& command);

}  // namespace genio
