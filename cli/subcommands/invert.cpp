#include "cli/subcommands/invert.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "cli/frame_files.hpp"
#include "cli/option_sets/inversion_options.hpp"
#include "cli/support.hpp"
#include "forward/model/build_model.hpp"
#include "report/answers/run_summary.hpp"
#include "runs/frames/frame_by_frame.hpp"
#include "runs/frames/inversion.hpp"
#include "runs/process/progress_line.hpp"
#include "runs/results/result_log.hpp"

namespace genio::cli {
namespace {

constexpr size_t most_tables = 10;  // of frames, one a frame; then one line

struct InvertOptions {
  InversionOptions asked;
  std::string out;
  int threads = 1;
  bool resume = false, json = false, quiet = false, verbose = false;
};

/// Hands the frame_message() of each frame that is not known to `collect`.
void answer(const Model& model, const std::vector<Frame>& frames, const FrameOptions& options,
            const AnswerRecords& known, const RegistrationRecord& registration,
            const InvertOptions& o, const Send& collect) {
  const std::vector<Frame> open = open_frames(frames, known);
  const auto to_message = [&](const ContourFrame& frame, const AnswerView& view,
                              const Positions& shape) {
    return frame_message(model, frame, with_registration(view, registration), shape, o.out);
  };
  if (!o.asked.joint())
    return answer_in_processes(model, open, {options, o.asked.sequence}, known, o.threads,
                               to_message, collect);
  if (open.empty()) return;
  const TakeAnswer take = [&](const ContourFrame& frame, const AnswerView& view,
                              const Positions& shape) {
    const std::string text = to_message(frame, view, shape);
    if (!known.contains(frame.number)) collect(text);
  };
  const auto progress = [&](double part, const std::string& what) {
    if (!o.quiet) print_progress(part, what);
  };
  const auto movement = answer_jointly(model, frames, options, o.asked, o.threads,
                                       Checkpoint(o.out, o.resume), progress, take);
  if (movement) write_movement(model, *movement, o.out);
}

/// Prints the frame_message() of a frame: as JSON, in one line on long runs, or as a table.
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
  check(o.asked);
  const auto remark = [&](const std::string& line) {
    if (!o.quiet) print_line(line);
  };
  const Model model = read_model(o.asked.model);
  const Measured measured = read_measured(
      o.asked.measured, [&]() -> const Model& { return model; }, remark);
  const std::vector<Frame> frames = frames_of(model, measured.frames, measured.noise, o.asked);
  const FrameOptions options = frame_options(model, o.asked, measured.head_pose);
  std::optional<ResultLog> log;
  if (!o.out.empty()) log.emplace(o.out, question_of(o.asked, measured.noise), o.resume);
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
  add_inversion_options(options, o->asked);
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
