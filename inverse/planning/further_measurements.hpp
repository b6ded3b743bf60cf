#pragma once
// Measurements that could be made of a shape.

#include "inverse/planning/prospects.hpp"

namespace genio {

/// What to measure as a text, KIND=PLACE,PLACE@NOISE; places and noise may be left out:
///
///     contour            the midsagittal contour where it is not measured yet
///     contour=root       a region of it: underside, tip, blade, dorsum or root
///     slice=dorsum       the contour across the tongue at a place of sensor_place()
///     sensors=tip+10mm   sensors glued there, measured in the midsagittal plane
///     emg=GGP,STY        activations of muscles
///     parameter=NAME     a parameter that the prior names, such as jaw_opening.angle
///
/// The noise is in mm, @0.5mm; of EMG a part of the maximum, @0.1; of a parameter in its own unit.
/// `x`: the shape at hand [m]; `measured`: what was measured of it. Throws InputError that names
/// the text and what was expected.
FurtherMeasurement further_measurement(const Model& model, const Target& measured,
                                       const Positions& x, const std::string& text);

/// The usual ones: contours, slices, sensors, and EMG of each of the muscles. What `measured` has
/// already is left out.
std::vector<std::string> usual_measurements(const Model& model, const Target& measured,
                                            const Positions& x,
                                            const std::vector<std::string>& muscles);

}  // namespace genio
