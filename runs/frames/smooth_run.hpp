#pragma once
#include "runs/frames/frame.hpp"
#include "runs/results/checkpoint.hpp"

namespace genio {

/// Work done, 0 to 1, and what is going on.
using TakeProgress = std::function<void(double part, const std::string& what)>;

/// All frames as one smoothing problem (infer_sequence()), by `threads` threads. Starts from what
/// the checkpoint holds, and keeps every step there.
void answer_smooth(const Model& model, const std::vector<Frame>& frames,
                   const FrameOptions& options, int threads, const Checkpoint& checkpoint,
                   const TakeProgress& progress, const TakeAnswer& take);

}  // namespace genio
