#pragma once
// A whole recording as one smoothing problem.

#include "inverse/search/multi_start.hpp"

namespace genio {

struct SequenceFrame {
  Target target;      ///< empty: left out
  double time_s = 0;  ///< of neighbours that are not later, 10 ms apart
};

struct SequenceOptions {
  InferOptions infer;
  StartOptions starts;
  int threads = 1;  ///< for the mechanics; Ipopt's turn comes once a step for all frames
  /// Unknowns of each frame from an interrupted run, to start from; empty: frame by frame first.
  std::vector<Vector> known;
  /// Told after the first pass and after every joint step: unknowns of every frame that has a
  /// target.
  std::function<void(const std::vector<Vector>&)> checkpoint;
  /// Work done, 0 to 1, and what is going on.
  std::function<void(double part, const std::string& what)> progress;
};

/// All frames' unknowns together minimise the sum of their misfits and priors and of the squared
/// steps from frame to frame over walk_sd(): what a Kalman smoother does where shapes are linear in
/// commands. First frame by frame, then joint local problems (descend()). Each answer's posterior
/// is the frame's marginal, its neighbours marginalised by Gaussian messages. One answer a frame;
/// those of empty targets have failed.
std::vector<Answer> infer_sequence(const Model& model, const std::vector<SequenceFrame>& frames,
                                   const Prior& prior, InferWorkspace& ws,
                                   const SequenceOptions& options = {});

}  // namespace genio
