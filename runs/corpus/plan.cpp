#include "runs/corpus/plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numeric>

#include "forward/base/text_file.hpp"
#include "forward/base/types.hpp"

namespace genio {
namespace {

using Json = nlohmann::json;

Json plan_json(const PlannedRecording& r) {
  return {{"name", r.name},
          {"file", r.file},
          {"speaker", r.speaker},
          {"line", r.line},
          {"words", r.words},
          {"model", r.model},
          {"noise", r.noise},
          {"frames", r.frames},
          {"whole", r.whole},
          {"refused", r.refused},
          {"question", r.question.empty() ? Json() : Json::parse(r.question)}};
}

PlannedRecording planned_of(const Json& json) {
  PlannedRecording r;
  json.at("name").get_to(r.name), json.at("file").get_to(r.file);
  json.at("speaker").get_to(r.speaker), json.at("line").get_to(r.line);
  json.at("words").get_to(r.words), json.at("model").get_to(r.model);
  json.at("noise").get_to(r.noise), json.at("frames").get_to(r.frames);
  json.at("whole").get_to(r.whole), json.at("refused").get_to(r.refused);
  if (!json.at("question").is_null()) r.question = json["question"].dump();
  return r;
}

Json plan_json(const Task& task) {
  Json pieces = Json::array();
  for (const Piece& p : task) pieces.push_back({p.recording, p.first, p.end});
  return pieces;
}

/// The pieces of a task; nothing of the file is believed.
Task task_of(const Json& json, const std::vector<PlannedRecording>& recordings) {
  Task task;
  for (const Json& p : json) {
    const Piece piece{p.at(0).get<int>(), p.at(1).get<int>(), p.at(2).get<int>()};
    if (piece.recording < 0 || piece.recording >= int(recordings.size()) || piece.first < 0 ||
        piece.end < piece.first ||
        piece.end > int(recordings[size_t(piece.recording)].frames.size()))
      throw InputError("a task has frames that no recording has");
    task.push_back(piece);
  }
  return task;
}

/// Recordings that give frames, one model after another.
std::vector<int> in_order(const std::vector<PlannedRecording>& recordings) {
  std::vector<int> order;
  for (size_t r = 0; r < recordings.size(); ++r)
    if (!recordings[r].frames.empty()) order.push_back(int(r));
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
    return recordings[size_t(a)].model < recordings[size_t(b)].model;
  });
  return order;
}

}  // namespace

int frames_of(const Task& task) {
  return std::accumulate(task.begin(), task.end(), 0,
                         [](int n, const Piece& p) { return n + p.end - p.first; });
}

int usual_share(int frames) {
  constexpr int few_tasks = 8, least = 50, most = 200, most_tasks = 1000;
  const auto parts = [&](int count) { return (frames + count - 1) / count; };
  return std::max(std::clamp(parts(few_tasks), least, most), parts(most_tasks));
}

std::vector<Task> cut(const std::vector<PlannedRecording>& recordings, int share) {
  const std::vector<int> order = in_order(recordings);
  int total = 0;
  for (const int r : order) total += int(recordings[size_t(r)].frames.size());
  std::vector<Task> tasks;
  if (total == 0) return tasks;
  const int count = (total + share - 1) / share, even = (total + count - 1) / count;
  int room = 0;
  for (const int r : order) {
    const int frames = int(recordings[size_t(r)].frames.size());
    const bool whole = recordings[size_t(r)].whole;
    for (int at = 0; at < frames;) {
      if (room <= 0 || (whole && room < frames && room < even)) tasks.emplace_back(), room = even;
      const int end = whole ? frames : std::min(frames, at + room);
      tasks.back().push_back({r, at, end});
      room -= end - at;
      at = end;
    }
  }
  return tasks;
}

void write_plan(const Plan& plan, const std::string& out) {
  Json json{{"folder", plan.folder}, {"share", plan.share}};
  json["recordings"] = json["tasks"] = Json::array();
  for (const PlannedRecording& r : plan.recordings) json["recordings"].push_back(plan_json(r));
  for (const Task& task : plan.tasks) json["tasks"].push_back(plan_json(task));
  write_text(out + "/plan.json", json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n");
}

Plan read_plan(const std::string& out) {
  const std::string path = out + "/plan.json";
  std::ifstream in(path);
  if (!in) throw InputError(path + ": no such file; expected the folder of a corpus");
  try {
    const Json json = Json::parse(in);
    Plan plan;
    json.at("folder").get_to(plan.folder), json.at("share").get_to(plan.share);
    for (const Json& r : json.at("recordings")) plan.recordings.push_back(planned_of(r));
    for (const Json& t : json.at("tasks")) plan.tasks.push_back(task_of(t, plan.recordings));
    return plan;
  } catch (const std::exception& e) {
    throw InputError(fmt::format("{}: is damaged ({}); name another --out", path, e.what()));
  }
}

std::string task_folder(const std::string& out, int task) {
  return fmt::format("{}/tasks/{:04}", out, task);
}

std::string lines_folder(const std::string& out, int task, const PlannedRecording& recording) {
  return task_folder(out, task) + "/" + recording.name;
}

}  // namespace genio
