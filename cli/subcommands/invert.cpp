#include "cli/subcommands/invert.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "cli/measured_options.hpp"
#include "cli/support.hpp"
#include "forward/base/text_file.hpp"
#include "forward/model/build_model.hpp"
#include "forward/model/model_file.hpp"
#include "inverse/prior/prior_file.hpp"
#include "report/answer_report.hpp"
#include "report/motion_report.hpp"
#include "report/run_summary.hpp"
#include "runs/frames/frame_by_frame.hpp"
#include "runs/frames/movement_run.hpp"
#include "runs/frames/smooth_run.hpp"
#include "runs/process/progress_line.hpp"
#include "runs/results/result_log.hpp"

namespace genio::cli {
namespace {

constexpr double outlier_dof = 4;   // of Student's t
constexpr size_t most_tables = 10;  // of frames, one a frame; then one line

struct InvertOptions {
  MeasuredOptions measured;
  std::string model = default_model(), out, prior;
  double deadline_s = 0;
  int starts = 0, threads = 1;
  bool bilateral = false, robust = false, resume = false, json = false, full_space = false;
  bool quiet = false, verbose = false;
  bool sequence = false, smooth = false, dynamic = false;
  MovementOptions movement;
};

void check(const InvertOptions& o) {
  if (!(o.movement.knot_s > 0) || !(o.movement.step_s > 0))
    throw InputError("--knot-s and --step-s: must be above 0");
}

std::vector<Frame> frames_of(const Model& model, const Measured& measured, const InvertOptions& o) {
  try {
    return make_frames(model, measured.frames, measured.noise, o.robust ? outlier_dof : 0);
  } catch (const InputError& e) {
    throw InputError(fmt::format("{}: {}", o.measured.target, e.what()));
  }
}

/// Errors name the file; a wrong muscle should not wait for the first frame.
Prior checked_prior(const Model& model, const InvertOptions& o) {
  if (o.prior.empty()) return {};
  const Prior prior = read_prior(o.prior);
  try {
    prior_terms(prior, unknowns_of(model, prior, o.bilateral));
  } catch (const InputError& e) {
    throw InputError(fmt::format("{}: {}", o.prior, e.what()));
  }
  return prior;
}

/// Which frames were asked for matters where all are one problem; else each is one of its own, and
/// another range goes on where this one ends.
QuestionValue range_of(const InvertOptions& o) {
  if (!o.smooth && !o.dynamic) return {};
  return fmt::format("{} {}", o.measured.choice.frames, fmt::join(o.measured.choice.labels, ","));
}

/// Everything an answer depends on.
Question question(const InvertOptions& o, double noise) {
  const MeasuredOptions& m = o.measured;
  return {{"genio", GENIO_VERSION},
          {"model", asked_file(o.model)},
          {"target", asked_file(m.target)},
          {"palate", asked_file(m.palate)},
          {"palate_sensor", m.palate_sensor},
          {"bite_plane", asked_file(m.bite_plane)},
          {"hyoid", m.hyoid},
          {"bite_plane_sensors", m.bite_plane_sensors},
          {"textgrid", asked_file(m.choice.textgrid)},
          {"tier", m.choice.tier},
          {"frames", range_of(o)},
          {"noise_mm", 1e3 * noise},
          {"format", m.read.format},
          {"units", m.read.units},
          {"mm_per_px", m.read.mm_per_px},
          {"facing", m.read.facing},
          {"y_grows", m.read.up},
          {"axes", m.read.axes},
          {"forced", m.force},
          {"sensors", m.sensors},
          {"columns", m.columns},
          {"spline", m.read.spline},
          {"points", m.read.points},
          {"palate_spline", m.palate_spline},
          {"rate_hz", m.read.rate_hz},
          {"registered", m.registered},
          {"prior", asked_file(o.prior)},
          {"deadline_s", o.deadline_s},
          {"starts", o.starts},
          {"bilateral", o.bilateral},
          {"robust", o.robust},
          {"sequence", o.sequence},
          {"full_space", o.full_space},
          {"smooth", o.smooth},
          {"dynamic", o.dynamic},
          {"knot_s", o.movement.knot_s},
          {"step_s", o.movement.step_s},
          {"from_rest", o.movement.from_rest},
          {"start_s", o.movement.start_s ? QuestionValue(*o.movement.start_s) : QuestionValue()}};
}

FrameOptions frame_options(const Model& model, const InvertOptions& o) {
  FrameOptions options;
  options.prior = checked_prior(model, o);
  options.infer.deadline_s = o.deadline_s;
  options.infer.full_space = o.full_space;
  if (o.bilateral) options.infer.bilateral = true;
  options.starts = {o.starts};
  return options;
}

/// Writes the answer's files. Gives its line of JSON, one for people, and below its table.
std::string message(const Model& model, const ContourFrame& frame, const AnswerView& view,
                    const Positions& shape, const std::string& out) {
  if (!out.empty()) {
    const std::string name = frame_name(frame.number);
    write_report(model, view, frame.number, out, name);
    if (shape.size() > 0) write_shape(model, shape, out + "/" + name + ".vtu");
  }
  return answer_json(view, frame.number) + "\n" + to_line(view) + "\n" + view.title + "\n" +
         to_table(view);
}

/// The commands as `genio forward --dynamic --commands` takes them, and the motion.
void write_movement(const Model& model, const MotionAnswer& a, const std::string& out) {
  if (out.empty() || a.status != InferStatus::converged) return;
  write_text(out + "/commands.csv", commands_csv(a));
  make_folder(out + "/motion");
  write_motion(model, a.trajectory, out + "/motion");
}

/// Hands the message() of each frame that is not known to `collect`.
void answer(const Model& model, const std::vector<Frame>& frames, const FrameOptions& options,
            const AnswerRecords& known, const RegistrationRecord& registration,
            const InvertOptions& o, const Send& collect) {
  const std::vector<Frame> open = open_frames(frames, known);
  const auto to_message = [&](const ContourFrame& frame, const AnswerView& view,
                              const Positions& shape) {
    return message(model, frame, with_registration(view, registration), shape, o.out);
  };
  if (!o.smooth && !o.dynamic)
    return answer_in_processes(model, open, {options, o.sequence}, known, o.threads, to_message,
                               collect);
  if (open.empty()) return;
  const Checkpoint checkpoint(o.out, o.resume);
  const TakeAnswer take = [&](const ContourFrame& frame, const AnswerView& view,
                              const Positions& shape) {
    const std::string text = to_message(frame, view, shape);
    if (!known.contains(frame.number)) collect(text);
  };
  const auto progress = [&](double part, const std::string& what) {
    if (!o.quiet) print_progress(part, what);
  };
  if (o.smooth) return answer_smooth(model, frames, options, o.threads, checkpoint, progress, take);
  const MotionAnswer a =
      answer_movement(model, frames, options, o.movement, checkpoint, progress, take);
  write_movement(model, a, o.out);
}

/// Prints the message() of a frame: as JSON, in one line on long runs, or as a table.
void print_answer(const std::string& message, const AnswerRecord& record, bool one_line,
                  const InvertOptions& o) {
  const size_t line = message.find('\n') + 1, table = message.find('\n', line) + 1;
  if (o.json) fmt::print("{}\n", record.line);
  if (!o.json && one_line) fmt::print("{}", message.substr(line, table - line));
  if (!o.json && !one_line) fmt::print("{}\n", message.substr(table));
  if (o.json && o.verbose) fmt::print(stderr, "{}\n", message.substr(table));
  std::fflush(stdout);
}

/// Those of `known` that are asked for again.
int asked_again(const AnswerRecords& known, const std::vector<Frame>& frames) {
  return int(std::count_if(frames.begin(), frames.end(),
                           [&](const Frame& f) { return known.contains(f.contour.number); }));
}

int run_checked(const InvertOptions& o) {
  check(o);
  const auto remark = [&](const std::string& line) {
    if (!o.quiet) print_line(line);
  };
  const Model model = read_model(o.model);
  const Measured measured = read_measured(
      o.measured, [&]() -> const Model& { return model; }, remark);
  const std::vector<Frame> frames = frames_of(model, measured, o);
  FrameOptions options = frame_options(model, o);
  if (!options.prior.head_pose) options.prior.head_pose = measured.head_pose;
  std::optional<ResultLog> log;
  if (!o.out.empty()) log.emplace(o.out, question(o, measured.noise), o.resume);
  const AnswerRecords known = log ? log->known() : AnswerRecords();
  const int done_before = asked_again(known, frames);
  if (!known.empty())
    remark(
        fmt::format("{} of {} frames are known from the run before", done_before, frames.size()));
  AnswerRecords answers = known;
  const bool one_line = o.quiet || (frames.size() > most_tables && !o.verbose);
  ProgressLine progress(done_before, int(frames.size()));
  answer(model, frames, options, known, measured.registration, o, [&](const std::string& text) {
    const AnswerRecord record = read_record(text.substr(0, text.find('\n'))).value();
    if (log) log->add(record);
    print_answer(text, record, one_line, o);
    answers[record.frame] = record;
    if (!o.quiet) progress.step();
  });
  if (answers.size() > 1) remark(summary_text(answers));
  if (log) write_summary(answers, o.out);
  return std::all_of(frames.begin(), frames.end(),
                     [&](const Frame& f) { return answers.at(f.contour.number).converged(); })
             ? done
             : no_answer;
}

/// A recording that cannot be laid beside the model gives no forces, but its registration.
int run(const InvertOptions& o) {
  try {
    return run_checked(o);
  } catch (const RegistrationFailed& e) {
    if (o.json) fmt::print("{}\n", no_forces_json(e.what(), e.record));
    throw;
  }
}

}  // namespace

Runner add_invert(Options& options) {
  auto o = std::make_shared<InvertOptions>();
  options.add("--model", o->model, "Model folder or model.toml");
  add_measured_options(options, o->measured);
  options.add("--prior", o->prior, "What is believed before: TOML, or a CSV of EMG");
  options.add("--starts", o->starts,
              "Descents a frame; more find other answers that fit (0: until the shape is "
              "explained)",
              {.range = {{0, 1000}}, .not_with = {"--dynamic"}});
  options.flag("--sequence", o->sequence, "Activations walk from frame to frame",
               {.not_with = {"--smooth", "--dynamic"}});
  options.flag("--smooth", o->smooth, "The same, all frames as one smoothing problem",
               {.not_with = {"--sequence", "--dynamic"}});
  options.flag("--dynamic", o->dynamic, "All frames as one movement, with inertia and viscosity");
  options.add("--knot-s", o->movement.knot_s, "--dynamic: between bends of the commands [s]",
              {.shows_default = true, .only_with = {"--dynamic"}});
  options.add("--step-s", o->movement.step_s, "--dynamic: time step [s]",
              {.shows_default = true, .only_with = {"--dynamic"}});
  options.add("--start-s", o->movement.start_s,
              "--dynamic: when the movement starts [s] (0.1 s before the first frame)",
              {.only_with = {"--dynamic"}});
  options.flag("--from-rest", o->movement.from_rest,
               "--dynamic: starts without commands; else from a posture that is found along",
               {.only_with = {"--dynamic"}});
  options.flag("--full-space", o->full_space,
               "Positions and commands together as unknowns: slower, to check the default by",
               {.not_with = {"--smooth", "--dynamic"}});
  options.flag("--robust", o->robust, "Noise with outliers (Student's t)");
  options.flag("--bilateral", o->bilateral, "Left and right together");
  options.add("--deadline-s", o->deadline_s, "Time a frame may take", {.positive = true});
  options.add("--threads", o->threads, "Worker processes, each with a run of neighbouring frames",
              {.range = {{1, 256}}, .not_with = {"--dynamic"}});
  options.flag("--json", o->json, "One JSON object a frame on standard output");
  options.flag("--quiet", o->quiet, "One line a frame, no remarks, no progress");
  options.flag("--verbose", o->verbose,
               "The table of every frame; else one line each where there are more than 10",
               {.not_with = {"--quiet"}});
  options.add("--out", o->out, "Folder for results.jsonl, a summary, pictures and shapes");
  options.flag("--resume", o->resume, "Take up an interrupted run, or go on with other frames",
               {.only_with = {"--out"}});
  options.footer("Example: genio invert --target data/examples/example_shape.csv --out results");
  return [o] { return run(*o); };
}

}  // namespace genio::cli
