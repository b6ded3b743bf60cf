#pragma once
// The message of a frame, and what is shown of its reply.

#include <optional>

#include "inverse/recording/base/contours.hpp"
#include "inverse/recording/registration/registration.hpp"
#include "runs/frames/measured.hpp"
#include "runs/results/answer_view.hpp"
#include "server/wire/wire.hpp"

namespace genio::cli {

/// Puts time, label and points of a frame into a request; `noise` [m] of points without their own.
void put_frame(const ContourFrame& frame, double noise, shape_request_t& request);

/// Says that the points are in a device's frame, where the palate's trace, (x, z) [m], lies so; it
/// may have no points.
void put_palate(const std::vector<Vec2>& trace, shape_request_t& request);

/// Where the server laid the points of a request; none where they came in the model's frame.
std::optional<Similarity> place_in_reply(const command_reply_t& reply);

/// What a reply says of its registration in one line; empty where it says nothing.
std::string registration_line(const command_reply_t& reply);

/// All of the reply but its registration; `frame` was asked about, and its points are shown as they
/// are.
AnswerView view_of(const command_reply_t& reply, const ContourFrame& frame);

}  // namespace genio::cli
