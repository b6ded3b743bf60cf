#pragma once
// Where the points of a request lie beside the model: in its frame by themselves, placed by numbers
// of an earlier reply, or still in a device's frame.

#include <functional>
#include <optional>

#include "runs/frames/registration_record.hpp"
#include "server/answer/message_place.hpp"
#include "server/wire/wire.hpp"

namespace genio {

/// How points came into the model's frame.
struct RequestPlacement {
  MessagePlace place;
  RegistrationRecord record;
};

/// A request's points in the model's frame.
struct LaidPoints {
  ContourFrame frame;
  std::optional<RequestPlacement> placement;  ///< none where they came there by themselves
};

/// Registers points in a device's frame as recordings are, with the model's reach that `reach`
/// gives only then; what its on_step throws passes through. What is wrong with that stands in the
/// record's judgement, and there are no points. Whoever places points by numbers insists on them:
/// where no tongue is, the record is `forced`. Throws InputError naming the field or the point.
LaidPoints laid_points(const Model& model, const shape_request_t& request,
                       const std::function<TongueReach()>& reach);

}  // namespace genio
