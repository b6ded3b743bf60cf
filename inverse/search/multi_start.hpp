#pragma once
// All forces that fit, not only the nearest.

#include "inverse/search/infer_workspace.hpp"

namespace genio {

struct StartOptions {
  /// Descents a target gets. 0: one, and more only until the misfit is within noise: five (four
  /// where a start is given), and up to sixteen while the likeliest optimum was found once only, or
  /// three times where it is far off.
  int starts = 0;
};

/// infer() from the shapes of the atlas that come nearest to the target (or from options.start
/// first, where it is given), then from draws of the prior: the likeliest optimum found, with those
/// that differ from it by more than their own spread as alternatives. Weights are shares of the
/// Laplace evidence. The atlas is made when it is first needed. Symmetric problems are solved on
/// half a tongue, see fits_half_tongue().
Answer infer_from_starts(const Model& model, const Target& target, const Prior& prior,
                         InferWorkspace& ws, const InferOptions& options = {},
                         const StartOptions& start_options = {});

}  // namespace genio
