#pragma once
#include <optional>

#include "speaker/adaptation/model_line.hpp"
#include "speaker/outline/thin_plate.hpp"

namespace genio {

/// Which place of an outline belongs to which of a model's midsagittal line. Places in turn.
struct LineMatch {
  std::vector<Vec2> from;    ///< places of the line in the model's rest shape [m]
  std::vector<double> node;  ///< the same as positions among the line's nodes, 1.5 between two
  std::vector<double> at;    ///< arc lengths along the outline, never decreasing [m]
  /// The bottom of the notch below the tip, where the outline has one.
  struct Notch {
    size_t node;  ///< of the line
    double at;    ///< arc length along the outline [m]
  };
  std::optional<Notch> notch = {};

  std::vector<PlacePair> pairs(const Polyline& outline) const;
  /// Between the places by proportion.
  double to_outline(double position) const;
  double to_line(double s) const;
  /// Shifts what belongs together about the notch so that its bottom does.
  void lead_into_notch();
};

/// Places `spacing` apart [m], each at the same part of the way between the same two landmarks:
/// hyoid, genial, floor, tip and vallecula. Of an outline that is a free surface alone only the
/// part from the floor to the vallecula.
LineMatch match_by_landmarks(const ModelLine& line, const Positions& rest,
                             const SpeakerOutline& outline, double spacing);

/// The map that lays the line on the outline and bends least, where all places but the first and
/// the last may slide along it from where `map` has them; `match` follows. `smoothing` as of
/// ThinPlateMap.
ThinPlateMap slid_map(LineMatch& match, const Polyline& outline, ThinPlateMap map,
                      double smoothing);

}  // namespace genio
