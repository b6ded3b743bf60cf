#include "cli/frame_files.hpp"

#include "forward/base/text_file.hpp"
#include "report/answers/answer_report.hpp"
#include "report/answers/answer_table.hpp"
#include "report/answers/motion_report.hpp"
#include "runs/results/answer_record.hpp"

namespace genio::cli {

std::string frame_message(const Model& model, const ContourFrame& frame, const AnswerView& view,
                          const Positions& shape, const std::string& out) {
  if (!out.empty()) {
    const std::string name = frame_name(frame.number);
    write_report(model, view, frame.number, out, name);
    if (shape.size() > 0) write_shape(model, shape, out + "/" + name + ".vtu");
  }
  return answer_json(view, frame.number) + "\n" + to_line(view) + "\n" + view.title + "\n" +
         to_table(view);
}

void write_movement(const Model& model, const MotionAnswer& a, const std::string& out) {
  if (out.empty() || a.status != InferStatus::converged) return;
  write_text(out + "/commands.csv", commands_csv(a));
  make_folder(out + "/motion");
  write_motion(model, a.trajectory, out + "/motion");
}

}  // namespace genio::cli
