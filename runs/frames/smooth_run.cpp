#include "runs/frames/smooth_run.hpp"

#include "inverse/sequence/sequence.hpp"

namespace genio {

void answer_smooth(const Model& model, const std::vector<Frame>& frames,
                   const FrameOptions& options, int threads, const Checkpoint& checkpoint,
                   const TakeProgress& progress, const TakeAnswer& take) {
  std::vector<SequenceFrame> measured;
  for (const Frame& f : frames) measured.push_back({f.target, f.contour.time_s});
  const SequenceOptions sequence{
      .infer = options.infer,
      .starts = options.starts,
      .threads = threads,
      .known = checkpoint.known(),
      .checkpoint = [&](const std::vector<Vector>& z) { checkpoint.keep(z); },
      .progress = progress};
  InferWorkspace ws(model);
  const auto answers = infer_sequence(model, measured, options.prior, ws, sequence);
  for (size_t k = 0; k < frames.size(); ++k)
    take(frames[k].contour, view_of(model, frames[k], answers[k]), answers[k].shape);
}

}  // namespace genio
