#include <fmt/format.h>

#include "cli/commands.hpp"
#include "cli/measured.hpp"
#include "forward/model_file.hpp"
#include "inverse/frame_target.hpp"
#include "inverse/multi_start.hpp"
#include "report/motion_report.hpp"

namespace genio::cli {
namespace {

constexpr double outlier_dof = 4;  // of Student's t

struct InvertOptions {
  MeasuredOptions measured;
  std::string model = default_model(), out;
  std::string prior;
  double deadline_s = 0;
  int starts = 0;
  bool bilateral = false, robust = false, json = false;
};

/// All of them before the first is worked on: a bad point should not end hours of work.
std::vector<Target> all_targets(const Model& model, const Measured& measured,
                                const std::string& file, bool robust) {
  std::vector<Target> targets;
  try {
    for (const ContourFrame& frame : measured.frames) {
      targets.push_back(make_target(model, frame, measured.noise));
      if (robust) targets.back().outlier_dof = outlier_dof;
    }
  } catch (const InputError& e) {
    throw InputError(fmt::format("{}: {}", file, e.what()));
  }
  return targets;
}

/// Errors name the file; a wrong muscle should not wait for the first frame.
Prior checked_prior(const Model& model, const InvertOptions& o) {
  const Prior prior = read_prior(o.prior);
  try {
    prior_terms(prior, unknowns(model, prior, o.bilateral));
  } catch (const InputError& e) {
    throw InputError(fmt::format("{}: {}", o.prior, e.what()));
  }
  return prior;
}

int run(const InvertOptions& o) {
  const Model model = read_model(o.model);
  const Measured measured = read_measured(o.measured, [&]() -> const Model& { return model; });
  const auto targets = all_targets(model, measured, o.measured.target, o.robust);
  const Prior prior = o.prior.empty() ? Prior{} : checked_prior(model, o);
  Workspace ws(model);
  AtlasCache atlas;
  InferOptions options;
  options.deadline_s = o.deadline_s;
  if (o.bilateral) options.bilateral = true;
  bool all = true;
  for (size_t i = 0; i < targets.size(); ++i) {
    const ContourFrame& frame = measured.frames[i];
    AnswerView view;
    Answer answer;
    if (targets[i].empty()) {
      view.title = frame_title(frame), view.status = "failed", view.verdict = "none";
      view.message = frame.note.empty() ? "the frame has no points" : frame.note;
    } else {
      answer = infer_from_starts(model, targets[i], prior, ws, atlas, options, {o.starts});
      view = view_of(model, targets[i], answer, frame_title(frame));
      if (answer.status == InferStatus::converged)
        options.start = answer.activations, options.start_shape = answer.shape;
    }
    all &= view.status == "converged";
    print_answer(view, frame.number, o.json);
    if (!o.out.empty()) {
      const std::string name = frame_name(frame);
      write_report(model, view, frame.number, o.out, name);
      if (answer.shape.size() > 0) write_shape(model, answer.shape, o.out + "/" + name + ".vtu");
    }
  }
  return all ? done : no_answer;
}

}  // namespace

Runner add_invert(CLI::App& app) {
  auto o = std::make_shared<InvertOptions>();
  app.add_option("--model", o->model, "Model folder or model.toml");
  add_measured_options(app, o->measured);
  app.add_option("--prior", o->prior, "What is believed before: TOML, or a CSV of EMG");
  app.add_option(
         "--starts", o->starts,
         "Descents a frame; more find other answers that fit (0: until the shape is explained)")
      ->check(CLI::Range(0, 1000));
  app.add_flag("--robust", o->robust, "Noise with outliers (Student's t)");
  app.add_flag("--bilateral", o->bilateral, "Left and right together");
  app.add_option("--deadline-s", o->deadline_s, "Time a frame may take");
  app.add_flag("--json", o->json, "One JSON object a frame on standard output");
  app.add_option("--out", o->out, "Folder for pictures, numbers and shapes");
  app.footer("Example: genio invert --target data/examples/example_shape.csv --out results");
  return [o] { return run(*o); };
}

}  // namespace genio::cli
