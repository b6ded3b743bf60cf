#pragma once
// What a reply says, from the values of the library.

#include "inverse/shape/infer.hpp"
#include "inverse/target/tongue_line.hpp"
#include "server/answer/request_placement.hpp"

namespace genio {

/// Everything that an answer, also one so far, tells of forces and fit; `line` is the model's.
void fill_answer(const TongueLine& line, const Answer& answer, command_reply_t& reply);

/// How the points were laid beside the model. Without a placement the reply stays as
/// reply_without_answer() made it, which says that they came in the model's frame.
void fill_placement(const std::optional<RequestPlacement>& placement, command_reply_t& reply);

/// Says of an answer that was filled in before that it is worth nothing, where the place of the
/// points is doubtful.
void withhold_doubtful_verdict(const std::optional<RequestPlacement>& placement,
                               command_reply_t& reply);

/// A reason as a reply may carry it: some 2000 bytes at most and none that steers a terminal, as it
/// may quote what a client sent.
std::string reason_text(const std::string& reason);

}  // namespace genio
