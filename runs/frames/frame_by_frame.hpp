#pragma once
// Frames one after another, each starting where the one before ended.

#include <optional>

#include "runs/frames/frame.hpp"
#include "runs/process/workers.hpp"

namespace genio {

struct FrameByFrame {
  FrameOptions frame;
  bool walks = false;  ///< activations walk from frame to frame, see Prior::smoothness_sd
};

/// `before`: the answer to the frame before the first, where that is known. `ws` is of the model.
void answer_frames(const Model& model, const std::vector<Frame>& frames,
                   const FrameByFrame& options, const std::optional<AnswerRecord>& before,
                   InferWorkspace& ws, const TakeAnswer& take);

/// The known answer to the frame before the first of `frames`.
std::optional<AnswerRecord> answer_before(const std::vector<Frame>& frames,
                                          const AnswerRecords& known);

/// The k-th of `count` runs of neighbours: its first item, and the one after its last.
std::pair<size_t, size_t> run_of_neighbours(size_t items, int k, int count);

/// Makes of an answer what is sent.
using MakeMessage =
    std::function<std::string(const ContourFrame&, const AnswerView&, const Positions& shape)>;

/// The same in up to `processes` processes, each with a run of neighbours. `message` is called in
/// the worker, which may write the answer's files; what it makes goes to `collect` here.
void answer_in_processes(const Model& model, const std::vector<Frame>& frames,
                         const FrameByFrame& options, const AnswerRecords& known, int processes,
                         const MakeMessage& message, const Send& collect);

}  // namespace genio
