#pragma once
// What beside palate and contours a session tells of the head. Not for other rooms.

#include <functional>

#include "inverse/recording/session/session.hpp"

namespace genio {

/// The marks as a reading of the axes has them. Throws InputError where a bite plane is no straight
/// line, or the model lacks a point.
HeadMarks marks_as(const Model& model, const SessionMarks& session, const AxesReading& reading);

/// The recording that `align` makes of those marks that the model has and that agree with the rest,
/// with its remarks and faults of the others as align() of a session promises them.
AlignedRecording by_marks_that_agree(
    const Model& model, SessionMarks marks,
    const std::function<AlignedRecording(const SessionMarks&)>& align);

}  // namespace genio
