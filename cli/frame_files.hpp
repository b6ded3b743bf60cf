#pragma once
// What an inversion leaves in its folder beside the lines of its results.

#include "runs/frames/movement_run.hpp"

namespace genio::cli {

/// Writes the pictures, numbers and shape of an answer into `out`, unless that is empty. Gives its
/// line of JSON, one for people, and below its table.
std::string frame_message(const Model& model, const ContourFrame& frame, const AnswerView& view,
                          const Positions& shape, const std::string& out);

/// The commands as `genio forward --dynamic --commands` takes them, and the motion.
void write_movement(const Model& model, const MotionAnswer& a, const std::string& out);

}  // namespace genio::cli
