#include "runs/corpus/task.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "forward/base/elapsed.hpp"
#include "forward/base/text_file.hpp"
#include "runs/corpus/kept_recording.hpp"
#include "runs/frames/frame_by_frame.hpp"
#include "runs/results/line_log.hpp"
#include "runs/results/result_log.hpp"

namespace genio {
namespace {

using Json = nlohmann::json;

/// Held while a task runs; another process waits for it. Where a file system has no locks, two
/// processes would only do the same work twice.
class TaskLock {
 public:
  explicit TaskLock(const std::string& path)
      : file_(open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666)) {
    if (file_ >= 0) flock(file_, LOCK_EX);
  }
  ~TaskLock() {
    if (file_ >= 0) close(file_);
  }
  TaskLock(const TaskLock&) = delete;
  TaskLock& operator=(const TaskLock&) = delete;

 private:
  int file_;
};

/// The last model and what is kept of it from recording to recording.
struct Tongue {
  std::string path;
  const Model* model = nullptr;
  std::optional<InferWorkspace> workspace = {};

  void take(const std::string& wanted, Models& models) {
    if (model && path == wanted) return;
    model = &models.get(wanted), path = wanted;
    workspace.emplace(*model);
  }
};

/// A recording as it was planned. Throws InputError where it, its model or prior has changed since.
InversionOptions asked_as_planned(const Plan& plan, const PlannedRecording& r,
                                  const ReadWords& read) {
  InversionOptions o = asked_of(r.words, plan.folder, read);
  const std::string other = difference(r.question, question_json(planned_question(o, r.noise, r)));
  if (!other.empty())
    throw InputError(
        fmt::format("{} was planned with {}; run the corpus with --resume", r.name, other));
  return o;
}

struct PieceRun {
  const std::string& out;
  const Plan& plan;
  int task;
  const ReadWords& read;
  const AnswerFiles& files;
  const std::function<void()>& step;
};

void answer_piece(const PieceRun& run, const Piece& piece, Models& models, Tongue& tongue) {
  const PlannedRecording& r = run.plan.recordings[size_t(piece.recording)];
  const InversionOptions o = asked_as_planned(run.plan, r, run.read);
  const std::string folder = run.out + "/" + r.name, lines = lines_folder(run.out, run.task, r);
  ResultLog log(lines, planned_question(o, r.noise, r), true);
  const KeptRecording kept = kept_recording(folder);
  tongue.take(o.model, models);
  const Model& model = *tongue.model;
  const auto frames = frames_of(model, kept_frames(folder, piece.first, piece.end), kept.noise, o);
  const std::vector<Frame> open = open_frames(frames, log.known());
  if (open.empty()) return;
  const TakeAnswer take = [&](const ContourFrame& frame, const AnswerView& view,
                              const Positions& shape) {
    if (log.known().contains(frame.number)) return;
    const std::string text = run.files.frame(
        model, frame, with_registration(view, kept.registration, kept.forced), shape, folder);
    log.add(read_record(text.substr(0, text.find('\n'))).value());
    run.step();
  };
  const FrameOptions options = frame_options(model, o, kept.head_pose);
  if (!o.joint())
    return answer_frames(model, open, {options, o.sequence}, answer_before(open, log.known()),
                         *tongue.workspace, take);
  const auto movement = answer_jointly(
      model, frames, options, o, 1, Checkpoint(lines, true), [](double, const std::string&) {},
      take);
  if (movement) run.files.movement(model, *movement, folder);
}

/// A line a run that came to its end, however that was.
void log_time(const std::string& folder, double wall_s, double cpu_s, int answers) {
  LineLog log(folder + "/time.jsonl", [](const std::string&) { return true; });
  log.add(Json{{"wall_s", wall_s}, {"cpu_s", cpu_s}, {"answers", answers}}.dump());
}

}  // namespace

void run_task(const std::string& out, const Plan& plan, int k, const ReadWords& read,
              Models& models, const AnswerFiles& files, const std::function<void()>& step) {
  const std::string folder = task_folder(out, k);
  make_folder(folder);
  const Stopwatch watch;
  const TaskLock lock(folder + "/lock");
  write_failures(out, k, {});
  int answers = 0;
  const std::function<void()> counted = [&] { ++answers, step(); };
  const PieceRun run{out, plan, k, read, files, counted};
  Tongue tongue;
  std::exception_ptr first;
  std::vector<TaskFailure> failures;
  for (const Piece& piece : plan.tasks[size_t(k)]) {
    try {
      answer_piece(run, piece, models, tongue);
    } catch (const std::exception& e) {
      if (!first) first = std::current_exception();
      failures.push_back({k, plan.recordings[size_t(piece.recording)].name, e.what()});
    }
  }
  write_failures(out, k, failures);
  log_time(folder, watch.seconds(), processor_seconds(), answers);
  if (first) std::rethrow_exception(first);
}

std::vector<TaskFailure> failures_of(const std::string& out, int k) {
  std::ifstream in(task_folder(out, k) + "/failed.json");
  const Json json = Json::parse(in, nullptr, false);
  std::vector<TaskFailure> failures;
  if (!json.is_array()) return failures;
  for (const Json& j : json)
    failures.push_back({k, j.value("recording", ""), j.value("reason", "")});
  return failures;
}

void write_failures(const std::string& out, int k, const std::vector<TaskFailure>& failures) {
  Json json = Json::array();
  for (const TaskFailure& f : failures)
    json.push_back({{"recording", f.recording}, {"reason", f.reason}});
  make_folder(task_folder(out, k));
  write_text(task_folder(out, k) + "/failed.json",
             json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n");
}

}  // namespace genio
