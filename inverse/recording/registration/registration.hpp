#pragma once
// Bringing a recording's own frame into the model's, by the palate both know.

#include <map>
#include <optional>
#include <vector>

#include "inverse/recording/base/bite_plane.hpp"
#include "inverse/recording/base/head_points.hpp"
#include "inverse/recording/registration/reach.hpp"

namespace genio {

/// q -> scale R(angle) q + shift in the midsagittal plane.
struct Similarity {
  double scale = 1, angle = 0;  ///< [-], [rad], counter-clockwise with x back and z up
  Vec2 shift = Vec2::Zero();    ///< [m]
  Vec2 operator()(const Vec2& q) const;
};

/// A point of the recording that is one of the model's within `sd`, lengths in metres.
struct KnownPlace {
  Vec2 in_recording, in_model;
  double sd = 0;
};

/// What beside palate and contours tells where the head was.
struct HeadMarks {
  std::optional<BitePlane> bite_plane = {};
  std::map<HeadPoint, KnownPlace> points = {};
};

struct Registration {
  Similarity transform;
  double palate_rms = 0;  ///< of the palate trace from the model's palate, after fitting [m]
  double cost = 0;        ///< what was minimised: squares in units of their standard deviations
  double off_reach = 0;   ///< of the median contour from a line that muscles make [m]
  /// The scale that the recording says by itself, and by how much that lowers its cost.
  double free_scale = 1, free_gain = 0;
  /// How well it is known: of the middle of what was registered [m], and of the tilt [rad].
  Vec2 shift_sd = Vec2::Zero();
  double tilt_sd = 0;
};

/// Root mean square distance of moved points from a line [m].
double rms_distance(const Similarity& s, const std::vector<Vec2>& points,
                    const std::vector<Vec2>& line);

/// Rigid motion and scale that lay the palate trace onto the model's midsagittal palate. Along a
/// smooth arch that leaves a slide, a tilt and the scale nearly free: on real ultrasound two
/// registrations fit the palate equally well (RMS 1 mm). So scale and tilt have weak priors (6 %
/// and 20 degrees), and the contours of all frames together decide, as much as 60 points: they lie
/// about the rest shape (5 mm), then about lines that the reach bends to them (2.5 mm). A bite
/// plane tells the tilt in place of its prior, and points of the head tell places within their
/// spread. Throws InputError when the model has no palate or the trace fewer than 5 points.
Registration register_by_palate(const Model& model, const TongueReach& reach,
                                const std::vector<Vec2>& palate_trace,
                                const std::vector<std::vector<Vec2>>& contours,
                                const HeadMarks& marks = {});

/// The same without a palate: the contours alone lie about the rest shape. Scale and tilt are known
/// by their priors and little else. Throws InputError for fewer than 5 points.
Registration register_by_contours(const TongueReach& reach,
                                  const std::vector<std::vector<Vec2>>& contours,
                                  const HeadMarks& marks = {});

}  // namespace genio
