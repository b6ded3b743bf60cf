#pragma once
// One inversion of a recording as it is asked for, whoever runs it: `genio invert`, or a task of a
// corpus.

#include "runs/frames/measured.hpp"
#include "runs/frames/movement_run.hpp"
#include "runs/results/question.hpp"

namespace genio {

/// All that an answer depends on, as the command line gives it; errors name its options.
struct InversionOptions {
  MeasuredOptions measured;
  std::string model, prior;
  double deadline_s = 0;
  int starts = 0;
  bool bilateral = false, robust = false, full_space = false;
  bool sequence = false, smooth = false, dynamic = false;
  MovementOptions movement;

  /// All frames are one problem.
  bool joint() const { return smooth || dynamic; }
};

/// A file that an option names.
struct OptionFile {
  std::string option;  ///< "--palate"
  std::string* path;   ///< empty where it is not given
};

/// The files that are read beside the target: one list for whoever moves or looks for them.
std::vector<OptionFile> files_beside(InversionOptions& o);

/// Throws InputError naming the option that cannot be.
void check(const InversionOptions& o);

/// Everything an answer depends on; `noise` [m] of the measured frames. Throws InputError where a
/// file cannot be read.
Question question_of(const InversionOptions& o, double noise);

/// make_frames(), whose errors name the target.
std::vector<Frame> frames_of(const Model& model, const std::vector<ContourFrame>& contours,
                             double noise, const InversionOptions& o);

/// Reads the prior; `head_pose` holds where that tells none. Throws InputError naming the file: a
/// wrong muscle should not wait for the first frame.
FrameOptions frame_options(const Model& model, const InversionOptions& o,
                           const std::optional<HeadPosePrior>& head_pose);

/// Answers all frames as the one problem that o.joint() makes of them. Gives the movement where
/// there is one.
std::optional<MotionAnswer> answer_jointly(const Model& model, const std::vector<Frame>& frames,
                                           const FrameOptions& options, const InversionOptions& o,
                                           int threads, const Checkpoint& checkpoint,
                                           const TakeProgress& progress, const TakeAnswer& take);

}  // namespace genio
