#pragma once
// A file's frames, one after another, each starting where the one before ended.

#include "cli/measured.hpp"
#include "cli/workers.hpp"
#include "inverse/search/multi_start.hpp"

namespace genio::cli {

struct OfflineOptions {
  Prior prior;
  InferOptions infer;
  StartOptions starts;
  bool sequence = false;  ///< activations walk from frame to frame, see Prior::smoothness_sd
  std::string out;        ///< folder for each frame's pictures, numbers and shapes; empty: none
};

struct Frame {
  ContourFrame contour;
  Target target;
};

/// What a frame without points gets.
AnswerView unanswered(const ContourFrame& frame);

/// Writes the frame's pictures, numbers and shape into `out` (where there is one), and sends it.
void send_answer(const Model& model, const ContourFrame& frame, const AnswerView& view,
                 const Positions& shape, const std::string& out, const Send& send);

/// What send() gets of a frame: {"answer": to_json(), "title", "table"}. `before`: the activations
/// of the frame before the first, as an answer tells them; may be null.
void answer_frames(const Model& model, const std::vector<Frame>& frames,
                   const OfflineOptions& options, const nlohmann::json& before, const Send& send);

}  // namespace genio::cli
