#pragma once
// What beside palate and contours a session tells of the head. Not for other rooms.

#include "inverse/recording/session.hpp"

namespace genio {

/// Standard deviation of a hyoid about the model's [m]: over 41 speakers it lies within 7 and 5 mm
/// of its mean place behind and below the incisors; a jaw that opens moves it by up to 7.
constexpr double hyoid_sd = 9e-3;

/// A trace is one frame; the sweep of a sensor is all of them. Points are (back, up) [m].
std::vector<Vec2> trace_of(const ContourFile& file);

/// The marks as a reading of the axes has them. Throws InputError where a bite plane is no straight
/// line, or the model has no hyoid.
HeadMarks marks_as(const Model& model, const SessionMarks& session, const AxesReading& reading);

}  // namespace genio
