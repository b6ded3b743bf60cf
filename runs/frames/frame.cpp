#include "runs/frames/frame.hpp"

#include <fmt/format.h>

#include <cmath>

#include "inverse/recording/base/unicode.hpp"
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

std::string frame_title(const ContourFrame& frame) {
  std::string from = frame.recording;
  if (!frame.speaker.empty())
    from += fmt::format("{}speaker {}", from.empty() ? "" : ", ", frame.speaker);
  return fmt::format("frame {}{}{}{}{}", frame.number,
                     std::isnan(frame.time_s) ? "" : fmt::format(" at {:.3f} s", frame.time_s),
                     frame.label.empty() ? "" : ": ", frame.label,
                     from.empty() ? "" : fmt::format(" ({})", from));
}

void tell_frame(const ContourFrame& frame, AnswerView& view) {
  view.title = utf8_of(frame_title(frame)), view.time_s = frame.time_s;
  view.label = utf8_of(frame.label), view.recording = utf8_of(frame.recording);
  view.speaker = utf8_of(frame.speaker);
}

AnswerView view_of(const Model& model, const Frame& frame, const Answer& answer) {
  const ContourFrame& contour = frame.contour;
  AnswerView view;
  if (!frame.target.empty()) {
    view = view_of(model, frame.target, answer);
  } else {
    view.status = "failed", view.verdict = "none";
    view.message = contour.note.empty() ? "the frame has no points" : contour.note;
  }
  tell_frame(contour, view);
  return view;
}

}  // namespace genio
