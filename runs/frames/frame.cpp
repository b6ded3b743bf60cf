#include "runs/frames/frame.hpp"

#include <fmt/format.h>

#include "inverse/recording/frame_target.hpp"

namespace genio {

std::vector<Frame> make_frames(const Model& model, const std::vector<ContourFrame>& contours,
                               double noise, double outlier_dof) {
  std::vector<Frame> frames;
  for (const ContourFrame& contour : contours) {
    frames.push_back({contour, make_target(model, contour, noise)});
    frames.back().target.outlier_dof = outlier_dof;
  }
  return frames;
}

std::vector<Frame> open_frames(const std::vector<Frame>& frames, const AnswerRecords& known) {
  std::vector<Frame> open;
  for (const Frame& frame : frames)
    if (!known.contains(frame.contour.number)) open.push_back(frame);
  return open;
}

std::string frame_name(const ContourFrame& frame) {
  return fmt::format("frame{:05d}", frame.number);
}

std::string frame_title(const ContourFrame& frame) {
  return fmt::format("frame {}{}{}", frame.number, frame.label.empty() ? "" : ": ", frame.label);
}

AnswerView view_of(const Model& model, const Frame& frame, const Answer& answer) {
  const ContourFrame& contour = frame.contour;
  if (!frame.target.empty()) return view_of(model, frame.target, answer, frame_title(contour));
  AnswerView view;
  view.title = frame_title(contour), view.status = "failed", view.verdict = "none";
  view.message = contour.note.empty() ? "the frame has no points" : contour.note;
  return view;
}

}  // namespace genio
