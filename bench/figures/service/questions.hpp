#pragma once
#include <vector>

#include "forward/model/model.hpp"
#include "genio/command_reply_t.hpp"
#include "genio/shape_request_t.hpp"

namespace genio::bench {

/// Requests that differ from each other and are answered within a fraction of a second: places of
/// the dorsum and the tip.
std::vector<shape_request_t> quick_questions(const Model& model, int count);

/// A request that computes for minutes, unless something ends it.
shape_request_t long_question(const Model& model);

/// Whether two replies say the same, forces within a thousandth of a newton.
bool same_answer(const command_reply_t& a, const command_reply_t& b);

}  // namespace genio::bench
