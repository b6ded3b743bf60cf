#pragma once
// Where a model has the points of the head that ultrasound shows, and how well they tell its place.
// Not for other rooms.

#include <optional>

#include "forward/model/model.hpp"
#include "inverse/recording/base/head_points.hpp"
#include "inverse/target/tongue_line.hpp"

namespace genio {

/// Standard deviation of a point about the model's [m], the root mean square of x and z. Over 41
/// speakers the hyoid lies within 7.2 and 5.0 mm of its mean place behind and below the incisors,
/// the mental spine within 4.8 and 3.8 and the mandible's lower inner edge within 5.0 and 3.4. A
/// jaw that opens in speech moves the hyoid by up to 7 and its own front by 5. Where the shadow
/// begins also depends on the probe's place, within some 4 mm.
double sd_of(HeadPoint point);

/// Where a model at rest has a point; empty where it lacks it. The hyoid's is the middle of the
/// bone's midsagittal cut. The short tendon leaves the mental spine, 8 mm above the mandible's
/// lower edge; models spread the fibres of the genioglossus up from there along the symphysis, so
/// that it is the lowest place where one of them starts at the jaw. A shadow begins at the edge of
/// the jaw's cut that is lowest and furthest back alike: there a beam from under the chin touches
/// the bone last.
std::optional<Vec2> place_in(const Model& model, HeadPoint point);

/// What such a model lacks: "the model file has no hyoid in [surfaces]".
std::string lack_of(HeadPoint point);

/// The median of points, coordinate by coordinate, and their spread about it as a standard
/// deviation [m], which stray ones leave as it is. It is 0 for fewer than three.
struct Middle {
  Vec2 point;
  double spread = 0;
};
Middle middle_of(const std::vector<Vec2>& points);

}  // namespace genio
