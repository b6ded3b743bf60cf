#include <fmt/format.h>

#include "cli/commands.hpp"
#include "forward/model_file.hpp"
#include "inverse/frame_target.hpp"
#include "inverse/infer.hpp"
#include "report/answer_report.hpp"

namespace genio::cli {
namespace {

struct InvertOptions {
  std::string model = default_model(), target, format = "auto", palate, frames, out;
  double noise_mm = 0, deadline_s = 0;
  bool bilateral = false, json = false;
};

/// "7" or "3-9"; empty means all.
std::pair<int, int> parse_frames(const std::string& text) {
  if (text.empty()) return {1, 1 << 30};
  int a = 0, b = 0;
  char rest = 0;
  const int n = std::sscanf(text.c_str(), "%d-%d%c", &a, &b, &rest);
  if (n == 1 && text.find('-') == std::string::npos) b = a;
  else if (n != 2) a = 0;
  if (a < 1 || b < a)
    throw InputError(fmt::format("--frames {}: expected A-B with 1 <= A <= B", text));
  return {a, b};
}

int run(const InvertOptions& o) {
  if (o.noise_mm < 0) throw InputError("--noise-mm: must be above 0");
  const auto [first, last] = parse_frames(o.frames);
  const Model model = read_model(o.model);
  const ContourFile file = read_contours(o.target, o.format);
  std::optional<Similarity> transform;
  if (!file.model_frame) {
    if (o.palate.empty())
      throw InputError(fmt::format(
          "{}: is in the device's own frame; give the same session's palate trace with --palate",
          o.target));
    const auto palate = midsagittal_points(read_contours(o.palate, o.format));
    if (palate.empty()) throw InputError(o.palate + ": no palate point has a value");
    const auto r = register_by_palate(model, palate.front(), midsagittal_points(file));
    transform = r.transform;
    fmt::print(
        stderr,
        "registered by the palate: scale {:.3f}, tilt {:.1f} degrees, palate RMS {:.2f} mm\n",
        r.transform.scale, r.transform.angle * 57.29578, 1e3 * r.palate_rms);
  }
  const double noise = o.noise_mm > 0 ? 1e-3 * o.noise_mm : default_noise(file.format);
  Workspace ws(model);
  InferOptions options;
  options.deadline_s = o.deadline_s;
  if (o.bilateral) options.bilateral = true;
  bool any = false, all = true;
  for (const ContourFrame& frame : file.frames) {
    if (frame.number < first || frame.number > last) continue;
    any = true;
    AnswerView view;
    Answer answer;
    const std::string title =
        fmt::format("frame {}{}{}", frame.number, frame.label.empty() ? "" : ": ", frame.label);
    if (frame.points.empty()) {
      view.title = title, view.status = "failed", view.verdict = "none";
      view.message = frame.note.empty() ? "the frame has no points" : frame.note;
    } else {
      const Target target = make_target(model, frame, transform, noise);
      answer = infer(model, target, Prior{}, ws, options);
      view = view_of(model, target, answer, title);
      if (answer.status == InferStatus::converged)
        options.start = answer.activations, options.start_shape = answer.shape;
    }
    all &= view.status == "converged";
    if (o.json) {
      fmt::print("{}\n", to_json(view, frame.number).dump());
      std::fflush(stdout);
    } else {
      fmt::print("{}\n{}\n", title, to_table(view));
    }
    if (!o.out.empty()) {
      const std::string name = fmt::format("frame{:05d}", frame.number);
      write_report(model, view, frame.number, o.out, name);
      if (answer.shape.size() > 0) write_shape(model, answer.shape, o.out + "/" + name + ".vtu");
    }
  }
  if (!any) throw InputError(fmt::format("--frames {}: {} has no such frame", o.frames, o.target));
  return all ? done : no_answer;
}

}  // namespace

Runner add_invert(CLI::App& app) {
  auto o = std::make_shared<InvertOptions>();
  app.add_option("--model", o->model, "Model folder or model.toml");
  app.add_option("--target", o->target, "Contour file")->required();
  app.add_option("--format", o->format, "auto, csv or aaa");
  app.add_option("--palate", o->palate, "Palate trace of the same session");
  app.add_option("--frames", o->frames, "A-B, counted from 1");
  app.add_option("--noise-mm", o->noise_mm, "Measurement noise (default 0.5 for CSV, 1.5 for AAA)");
  app.add_flag("--bilateral", o->bilateral, "Left and right together");
  app.add_option("--deadline-s", o->deadline_s, "Time a frame may take");
  app.add_flag("--json", o->json, "One JSON object a frame on standard output");
  app.add_option("--out", o->out, "Folder for pictures, numbers and shapes");
  app.footer("Example: genio invert --target data/examples/example_shape.csv --out results");
  return [o] { return run(*o); };
}

}  // namespace genio::cli
