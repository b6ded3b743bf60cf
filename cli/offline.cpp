#include "cli/offline.hpp"

#include <cmath>

#include "inverse/sequence/chained_prior.hpp"
#include "report/motion_report.hpp"

namespace genio::cli {
namespace {

/// The unknowns of an earlier answer; empty where they are not all told.
Vector told_unknowns(const nlohmann::json& answer, const std::vector<Unknown>& commands) {
  if (answer.value("status", "") != "converged") return {};
  Vector z(Eigen::Index(commands.size()));
  for (size_t i = 0; i < commands.size(); ++i) {
    const std::string& name = commands[i].name;
    if (answer["activation"].contains(name)) z[Eigen::Index(i)] = answer["activation"][name];
    else if (answer["estimated"].contains(name))
      z[Eigen::Index(i)] = commands[i].z_of(answer["estimated"][name]["value"].get<double>());
    else return {};
  }
  return z;
}

}  // namespace

AnswerView unanswered(const ContourFrame& frame) {
  AnswerView view;
  view.title = frame_title(frame), view.status = "failed", view.verdict = "none";
  view.message = frame.note.empty() ? "the frame has no points" : frame.note;
  return view;
}

void send_answer(const Model& model, const ContourFrame& frame, const AnswerView& view,
                 const Positions& shape, const std::string& out, const Send& send) {
  if (!out.empty()) {
    const std::string name = frame_name(frame);
    write_report(model, view, frame.number, out, name);
    if (shape.size() > 0) write_shape(model, shape, out + "/" + name + ".vtu");
  }
  send({{"answer", to_json(view, frame.number)}, {"title", view.title}, {"table", to_table(view)}});
}

void answer_frames(const Model& model, const std::vector<Frame>& frames, const OfflineOptions& o,
                   const nlohmann::json& before, const Send& send) {
  InferWorkspace ws(model);
  InferOptions infer = o.infer;
  double last_time = std::nan("");
  for (const Frame& frame : frames) {
    AnswerView view = unanswered(frame.contour);
    Answer answer;
    if (!frame.target.empty()) {
      Prior prior = o.prior;
      if (&frame == &frames.front() && before.is_object())
        infer.start = told_unknowns(
            before,
            unknowns_of(model, prior, infer.bilateral.value_or(frame.target.midsagittal())));
      if (o.sequence && infer.start.size() > 0) {
        prior.before = Prior::Before{infer.start, walk_sd(prior, last_time, frame.contour.time_s)};
      }
      answer = infer_from_starts(model, frame.target, prior, ws, infer, o.starts);
      view = view_of(model, frame.target, answer, frame_title(frame.contour));
      if (answer.status == InferStatus::converged) start_from(answer, infer);
      last_time = frame.contour.time_s;
    }
    send_answer(model, frame.contour, view, answer.shape, o.out, send);
  }
}

}  // namespace genio::cli
