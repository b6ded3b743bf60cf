#pragma once
// How speakers' outlines vary: a mean, a few modes with names, and what these leave.

#include <string>
#include <vector>

#include "inverse/recording/registration/registration.hpp"
#include "speaker/modes/outline_points.hpp"

namespace genio {

/// Outlines are mean + sum_k m_k mode_k + apart, with m_k of unit variance among speakers, one
/// independent of another, and `apart` by every coordinate alone. Coordinates stand as in
/// stacked_places() [m].
struct OutlineModes {
  std::vector<std::string> names;  ///< of the first modes; the others have none
  Vector mean;
  Matrix modes;      ///< a column a mode, of one standard deviation
  Vector apart;      ///< standard deviations of what goes with no mode
  double kept = 1;   ///< of the modes' variance; the rest of 1 is part of `apart`
  int speakers = 0;  ///< that it was made from

  Eigen::Index named() const { return Eigen::Index(names.size()); }
};

/// Of at least 8 speakers whose outlines are known as a whole, wherever each lies. They are laid on
/// one another by rigid motions of the palate's front and the tongue's surface that probes see
/// (Procrustes). The first modes are guided, each the regression of what is left on one measure:
/// size, palate_height, pharynx_length, jaw_height, tongue_length and pharynx_depth. Those after
/// are principal components of the rest, shape1 and shape2 the first of them. Of the covariance a
/// part goes from between coordinates to these alone, as much as its sampling error says (Schaefer
/// and Strimmer 2005). Throws std::invalid_argument where a point is not known.
OutlineModes modes_of_outlines(const std::vector<OutlinePoints>& speakers);

/// The points that a palate trace and a probe see, as indices: the palate's front, and the surface
/// from near the tip to where the hyoid's shadow begins.
std::vector<int> points_in_sight();

/// The rigid motion that takes some of the places nearest to others (least squares).
Similarity rigidly_laid(const std::vector<Vec2>& from, const std::vector<Vec2>& to,
                        const std::vector<int>& which);

}  // namespace genio
