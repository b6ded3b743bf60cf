#pragma once
#include <optional>

#include "inverse/sequence/motion_inversion.hpp"
#include "runs/frames/smooth_run.hpp"
#include "runs/results/checkpoint.hpp"

namespace genio {

struct MovementOptions {
  double knot_s = 0.05, step_s = 0.002;
  std::optional<double> start_s;  ///< when it starts; unset: 0.1 s before the first frame
  bool from_rest = false;
};

/// All frames as one movement with inertia (infer_motion()). Starts from what the checkpoint holds,
/// and keeps every step there.
MotionAnswer answer_movement(const Model& model, const std::vector<Frame>& frames,
                             const FrameOptions& options, const MovementOptions& movement,
                             const Checkpoint& checkpoint, const TakeProgress& progress,
                             const TakeAnswer& take);

/// The commands at a time between knots; values, standard deviations and intervals are linear too.
/// At least two knots.
std::vector<Estimate> commands_at(const MotionAnswer& answer, double time_s);

/// The commands at the knots as `genio forward --dynamic --commands` reads them.
std::string commands_csv(const MotionAnswer& answer);

}  // namespace genio
