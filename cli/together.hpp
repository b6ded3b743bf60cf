#pragma once
// All frames of a file in one problem.

#include "cli/offline.hpp"

namespace genio::cli {

struct TogetherOptions {
  bool dynamic = false;  ///< a movement with inertia; else a smooth sequence of equilibria
  int threads = 1;
  double knot_s = 0.05, step_s = 0.002;
  std::optional<double> start_s;  ///< when the movement starts; unset: 0.1 s before the first frame
  bool from_rest = false;
  bool resume = false;
};

/// As answer_frames(), for all of them at once. With a folder in `options`, progress is kept in
/// checkpoint.json there and taken up by `resume`; a movement leaves commands.csv (for `genio
/// forward
/// --dynamic --commands`) and motion/.
void answer_together(const Model& model, const std::vector<Frame>& frames,
                     const OfflineOptions& options, const TogetherOptions& how, const Send& send);

}  // namespace genio::cli
