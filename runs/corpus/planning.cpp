#include "runs/corpus/planning.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "forward/base/text_file.hpp"
#include "forward/model/build_model.hpp"
#include "runs/corpus/kept_recording.hpp"
#include "runs/process/workers.hpp"

namespace genio {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

/// A row of the manifest, what it asks, and what is planned of it.
struct Row {
  const ManifestRow* row;
  InversionOptions asked;
  PlannedRecording planned;
  bool open = true;  ///< it has to be read
};

PlannedRecording planned_row(const ManifestRow& row, const InversionOptions& asked) {
  PlannedRecording p;
  p.name = row.name, p.file = row.recording, p.speaker = row.speaker, p.line = row.line;
  p.words = row.words, p.model = asked.model;
  return p;
}

/// Reads, registers and keeps one recording. Gives what is planned of it.
PlannedRecording read_recording(const Row& r, const Model& model, const std::string& out) {
  PlannedRecording p = r.planned;
  std::vector<std::string> remarks;
  Measured m = read_measured(
      r.asked.measured, [&]() -> const Model& { return model; },
      [&](const std::string& line) { remarks.push_back(line); });
  frame_options(model, r.asked, m.head_pose);  // a bad prior is found here and not by every task
  frames_of(model, m.frames, m.noise, r.asked);
  for (ContourFrame& frame : m.frames) {
    if (frame.recording.empty()) frame.recording = p.name;
    if (!p.speaker.empty()) frame.speaker = p.speaker;
    p.frames.push_back(frame.number);
  }
  p.noise = m.noise, p.whole = r.asked.joint() || r.asked.sequence;
  p.question = question_json(planned_question(r.asked, m.noise, p));
  keep_recording(m, remarks, out + "/" + p.name);
  return p;
}

/// What a process that reads a recording tells of it.
std::string told(const PlannedRecording& p) {
  return Json{
      {"noise", p.noise}, {"whole", p.whole}, {"frames", p.frames}, {"question", p.question}}
      .dump();
}

void hear(PlannedRecording& p, const std::string& text) {
  const Json json = Json::parse(text);
  json.at("noise").get_to(p.noise), json.at("whole").get_to(p.whole);
  json.at("frames").get_to(p.frames), json.at("question").get_to(p.question);
}

/// Reads the open rows, `processes` at a time.
void read_open(std::vector<Row>& rows, const std::string& out, int processes, Models& models,
               const TakeRead& take) {
  std::vector<Row*> open;
  int done = 0;
  const int total =
      int(std::count_if(rows.begin(), rows.end(), [](const Row& r) { return r.open; }));
  for (Row& r : rows) {
    if (!r.open) continue;
    try {
      models.get(r.asked.model);  // here, so that every process has it
      open.push_back(&r);
    } catch (const InputError& e) {
      r.planned.refused = e.what();
      take(r.planned, ++done, total);
    }
  }
  const auto work = [&](int k, const Send& send) {
    const Row& r = *open[size_t(k)];
    send(fmt::format("{} {}", k, told(read_recording(r, models.get(r.asked.model), out))));
  };
  const auto collect = [&](const std::string& text) {
    const size_t blank = text.find(' ');
    hear(open[std::stoul(text.substr(0, blank))]->planned, text.substr(blank + 1));
  };
  in_turn(int(open.size()), processes, work, collect, [&](int k, const Ending& ending) {
    PlannedRecording& p = open[size_t(k)]->planned;
    if (ending.how != How::done) p.refused = ending.reason, p.frames.clear();
    take(p, ++done, total);
  });
}

/// Throws InputError where a planned recording is asked for in another way now.
void check_unchanged(const PlannedRecording& before, const Row& now, const std::string& manifest,
                     const std::string& out) {
  const double noise =
      now.asked.measured.noise_mm > 0 ? 1e-3 * now.asked.measured.noise_mm : before.noise;
  const std::string other =
      difference(before.question, question_json(planned_question(now.asked, noise, now.planned)));
  if (!other.empty())
    throw InputError(
        fmt::format("--resume: {}:{}: {} was planned with {}; name another --out, or "
                    "remove {}/{} to have it answered anew",
                    manifest, now.row->line, before.name, other, out, before.name));
}

/// Takes a recording out of all tasks, with its lines.
void forget(Plan& plan, int recording, const std::string& out) {
  for (size_t t = 0; t < plan.tasks.size(); ++t) {
    if (std::erase_if(plan.tasks[t], [&](const Piece& p) { return p.recording == recording; }) == 0)
      continue;
    std::error_code none;
    fs::remove_all(lines_folder(out, int(t), plan.recordings[size_t(recording)]), none);
  }
}

/// Closes the rows that are planned as they are, and makes room for those that are read again.
void take_up(Plan& plan, std::vector<Row>& rows, const Manifest& manifest, const std::string& out) {
  for (size_t k = 0; k < plan.recordings.size(); ++k) {
    const PlannedRecording& before = plan.recordings[k];
    const auto row = std::find_if(rows.begin(), rows.end(),
                                  [&](const Row& r) { return r.planned.name == before.name; });
    if (row == rows.end())
      throw InputError(fmt::format("--resume: {} lacks {}, which {} holds; name another --out",
                                   manifest.path, before.file, out));
    if (!before.refused.empty()) continue;
    if (!fs::exists(out + "/" + before.name + "/frames.jsonl")) {
      forget(plan, int(k), out);
      continue;
    }
    check_unchanged(before, *row, manifest.path, out);
    const int line = row->planned.line;
    row->planned = before, row->planned.line = line, row->open = false;
  }
}

/// The rows' recordings in the plan: those that it has keep their places.
void put(Plan& plan, const std::vector<Row>& rows) {
  for (const Row& r : rows) {
    const auto place =
        std::find_if(plan.recordings.begin(), plan.recordings.end(),
                     [&](const PlannedRecording& p) { return p.name == r.planned.name; });
    if (place != plan.recordings.end()) *place = r.planned;
    else plan.recordings.push_back(r.planned);
  }
}

}  // namespace

Question planned_question(const InversionOptions& o, double noise, const PlannedRecording& r) {
  Question asked = question_of(o, noise);
  asked.emplace_back("frames", fmt::format("{} {}", o.measured.choice.frames,
                                           fmt::join(o.measured.choice.labels, ",")));
  asked.emplace_back("recording", r.name);
  asked.emplace_back("speaker", r.speaker);
  return asked;
}

const Model& Models::get(const std::string& path) {
  const auto it = models_.find(path);
  return it != models_.end() ? it->second : models_.emplace(path, read_model(path)).first->second;
}

Plan plan_corpus(const Manifest& manifest, const std::string& out, const PlanningOptions& options,
                 const ReadWords& read, Models& models, const TakeRead& take) {
  make_folder(out);
  const bool before = fs::exists(out + "/plan.json");
  if (before && !options.resume)
    throw InputError(fmt::format(
        "--out {}: holds a corpus already; --resume takes it up, or name another folder", out));
  std::vector<Row> rows;
  for (const ManifestRow& row : manifest.rows) {
    const InversionOptions asked = asked_of(row.words, manifest.folder, read);
    rows.push_back({&row, asked, planned_row(row, asked)});
  }
  Plan plan;
  if (before) plan = read_plan(out);
  if (before && options.share > 0 && options.share != plan.share)
    throw InputError(
        fmt::format("--share {}: {} was planned with {}", options.share, out, plan.share));
  take_up(plan, rows, manifest, out);
  read_open(rows, out, options.processes, models, take);
  put(plan, rows);
  std::vector<PlannedRecording> fresh = plan.recordings;
  int frames = 0;
  for (PlannedRecording& p : fresh) {
    const bool open = std::any_of(rows.begin(), rows.end(),
                                  [&](const Row& r) { return r.open && r.planned.name == p.name; });
    if (!open) p.frames.clear();
    frames += int(p.frames.size());
  }
  plan.folder = manifest.folder;
  if (plan.share == 0) plan.share = options.share > 0 ? options.share : usual_share(frames);
  for (Task& task : cut(fresh, plan.share)) plan.tasks.push_back(std::move(task));
  write_plan(plan, out);
  return plan;
}

}  // namespace genio
