#include "cli/subcommands/plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "cli/option_sets/inversion_options.hpp"
#include "cli/support.hpp"
#include "forward/model/build_model.hpp"
#include "inverse/planning/further_measurements.hpp"
#include "report/answers/plan_report.hpp"
#include "runs/frames/frame.hpp"
#include "runs/process/progress_line.hpp"

namespace genio::cli {
namespace {

struct PlanCommand {
  InversionOptions asked;
  std::vector<std::string> measure;
  int draws = 8;
  bool json = false, quiet = false;
};

/// Those of which the shape at hand leaves something open.
std::vector<std::string> open_muscles(const Answer& answer) {
  constexpr double known = 0.02;  // width of an interval over the maximum
  std::vector<std::string> names;
  for (const Estimate& e : answer.muscles)
    if (!e.fixed && (e.high - e.low > known * e.maximum || std::min(e.acts, 1 - e.acts) > known))
      names.push_back(e.name);
  return names;
}

/// Prints what is to be measured of a frame; false where the frame has no answer.
bool plan(const Model& model, const Frame& frame, const FrameOptions& options, InferWorkspace& ws,
          const PlanCommand& o) {
  const Answer answer =
      infer_from_starts(model, frame.target, options.prior, ws, options.infer, options.starts);
  if (answer.status != InferStatus::converged) {
    print_line(fmt::format("{}: {}: {}", frame_title(frame.contour), to_string(answer.status),
                           answer.message));
    return false;
  }
  const auto texts = o.measure.empty() ? usual_measurements(model, frame.target, answer.shape,
                                                            open_muscles(answer))
                                       : o.measure;
  std::vector<FurtherMeasurement> candidates;
  for (const std::string& text : texts)
    candidates.push_back(further_measurement(model, frame.target, answer.shape, text));
  InferOptions infer = options.infer;
  if (!infer.bilateral) infer.bilateral = frame.target.midsagittal();
  LongWork working("trying measurements");
  const auto progress = [&](int done, int all) {
    if (!o.quiet) working(double(done) / all);
  };
  const Prospects found = prospects(model, frame.target, options.prior, answer, candidates,
                                    ws.whole().workspace, infer, {o.draws, progress});
  if (o.json) {
    fmt::print("{}\n", plan_json(frame, answer, found));
  } else {
    fmt::print("{}: {}\n", frame_title(frame.contour), to_string(answer.verdict));
    if (answer.verdict != Verdict::explained)
      fmt::print("the model does not explain this shape: what it expects of others may mislead\n");
    fmt::print("{}\n", plan_table(found));
  }
  std::fflush(stdout);
  return true;
}

int run(const PlanCommand& o) {
  check(o.asked);
  const auto remark = [&](const std::string& line) {
    if (!o.quiet) print_line(line);
  };
  const Model model = read_model(o.asked.model);
  const Measured measured = read_measured(
      o.asked.measured, [&]() -> const Model& { return model; }, remark);
  const auto frames = frames_of(model, measured.frames, measured.noise, o.asked);
  const FrameOptions options = frame_options(model, o.asked, measured.head_pose);
  InferWorkspace ws(model);
  bool all = true;
  for (const Frame& frame : frames) {
    if (frame.target.empty()) {
      remark(fmt::format("{}: {}", frame_title(frame.contour), frame.contour.note));
      continue;
    }
    all = plan(model, frame, options, ws, o) && all;
  }
  return all ? done : no_answer;
}

}  // namespace

Runner add_plan(Options& options) {
  auto o = std::make_shared<PlanCommand>();
  add_shape_options(options, o->asked);
  options.add("--measure", o->measure,
              "What could be measured, each by its own --measure: contour, contour=root, "
              "slice=dorsum, sensors=tip+10mm,tip+25mm, emg=GGP, parameter=NAME@SD; with its noise "
              "as in slice=dorsum@0.3mm (the usual ones)");
  options.add("--draws", o->draws, "Truths that each is tried on",
              {.shows_default = true, .range = {{1, 1000}}});
  options.flag("--json", o->json, "One JSON object a frame on standard output");
  options.flag("--quiet", o->quiet, "No remarks, no progress");
  options.footer("Example: genio plan --target data/examples/example_shape.csv");
  return [o] { return run(*o); };
}

}  // namespace genio::cli
