#pragma once
// A movement as one optimal-control problem.

#include "forward/motion/motion_sensitivity.hpp"
#include "inverse/search/multi_start.hpp"
#include "inverse/target/comparison.hpp"

namespace genio {

/// What was measured at one instant of a movement.
struct MotionFrame {
  Target target;
  double time_s;  ///< after the movement's start, above 0
};

struct MotionOptions {
  TimeOptions time;      ///< step and scheme; it lasts until the last frame
  double knot_s = 0.05;  ///< between the instants where commands may bend [s]
  /// Start at rest, without commands; else at the equilibrium of the first knot's commands, which
  /// are found along.
  bool from_rest = true;
  InferOptions infer;
  std::vector<Vector> known;  ///< unknowns at each knot, to start from; empty: from static answers
  std::function<void(const std::vector<Vector>&)> checkpoint;  ///< told of every accepted step
  std::function<void(double part, const std::string& what)> progress;
};

struct MotionAnswer {
  struct Frame {
    double time_s = 0;
    Positions shape;      ///< [m]
    Residuals residuals;  ///< at the optimum
  };
  InferStatus status = InferStatus::failed;
  std::string message;
  Verdict verdict = Verdict::none;  ///< of all frames together
  std::vector<double> knots_s;
  /// Unknowns at each knot: forces [N] or other parameters, linear between knots.
  std::vector<std::vector<Estimate>> estimates;
  std::vector<std::vector<JointForce>> joint;  ///< of each knot, see Answer
  std::vector<Vector> unknowns;  ///< the same as unknowns z
  std::vector<Frame> frames;
  double rms = 0, chi2_per_dof = 0;  ///< rms over all points [m]
  Trajectory trajectory;             ///< of the whole tongue
  int iterations = 0, simulations = 0, factorizations = 0;
  double wall_s = 0;
};

/// Commands, linear in time between knots, that minimise the misfit at all frames, effort at the
/// knots, and the squared steps from knot to knot over the prior's walk (smoothness_sd). The tongue
/// moves by the equation of motion (simulate()); gradients are exact derivatives of its steps
/// (motion_sensitivity()), the descent is descend()'s. Symmetric problems run on half a tongue.
/// Throws InputError for frames that are empty or not later than 0, a head pose in the prior, or
/// a model without viscosity or mass.
MotionAnswer infer_motion(const Model& model, const std::vector<MotionFrame>& frames,
                          const Prior& prior, InferWorkspace& ws,
                          const MotionOptions& options = {});

}  // namespace genio
