#pragma once
// The frames of a recording, ready to be answered.

#include <functional>
#include <string>
#include <vector>

#include "inverse/recording/contour_file.hpp"
#include "inverse/search/multi_start.hpp"
#include "runs/results/answer_record.hpp"

namespace genio {

struct Frame {
  ContourFrame contour;
  Target target;  ///< empty where the contour has no points
};

/// Targets of all contours, which are in the model's frame: a bad point should not end hours of
/// work. `noise` [m] as in make_target(); `outlier_dof` of Student's t, 0: Gaussian noise. Throws
/// InputError naming the point.
std::vector<Frame> make_frames(const Model& model, const std::vector<ContourFrame>& contours,
                               double noise, double outlier_dof);

/// Those whose answers are not known yet, in the same order.
std::vector<Frame> open_frames(const std::vector<Frame>& frames, const AnswerRecords& known);

/// "frame 7 at 1.234 s: word (take_3, speaker S2)", as far as it is known.
std::string frame_title(const ContourFrame& frame);
/// Puts title, time, label, recording and speaker of a frame into what is shown of its answer.
void tell_frame(const ContourFrame& frame, AnswerView& view);

/// What every way to answer frames takes.
struct FrameOptions {
  Prior prior;
  InferOptions infer;
  StartOptions starts;
};

/// Takes a frame's answer as soon as it is known; the shape [m] is empty where there is none.
using TakeAnswer =
    std::function<void(const ContourFrame&, const AnswerView&, const Positions& shape)>;

/// What is shown of a frame's answer; of a frame without points: why it has none.
AnswerView view_of(const Model& model, const Frame& frame, const Answer& answer);

}  // namespace genio
