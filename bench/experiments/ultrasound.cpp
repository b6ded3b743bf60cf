#include "bench/experiments/ultrasound.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "forward/model/build_model.hpp"
#include "forward/model/model_file.hpp"
#include "inverse/recording/frame_target.hpp"
#include "inverse/recording/session/session.hpp"
#include "inverse/search/multi_start.hpp"
#include "runs/frames/registration_record.hpp"

namespace genio::bench {
namespace {

/// The frame in the middle of each run of one label's frames, in the file's order.
std::vector<const ContourFrame*> middle_frames(const ContourFile& file) {
  std::vector<std::string> order;
  std::map<std::string, std::vector<const ContourFrame*>> by_label;
  for (const auto& frame : file.frames) {
    auto& frames = by_label[frame.label];
    if (frames.empty()) order.push_back(frame.label);
    frames.push_back(&frame);
  }
  std::vector<const ContourFrame*> result;
  for (const auto& label : order) result.push_back(by_label[label][by_label[label].size() / 2]);
  return result;
}

std::vector<const ContourFrame*> every_frame(const ContourFile& file) {
  std::vector<const ContourFrame*> result;
  for (const auto& frame : file.frames) result.push_back(&frame);
  return result;
}

/// As `genio invert` asks. `infer`: where to start, replaced by where it ended.
Json answer_frame(const Model& m, const ContourFrame& frame, const Registration& registration,
                  double noise, InferWorkspace& ws, InferOptions& infer) {
  Json j = {{"frame", frame.number}, {"label", frame.label}};
  const Target target = make_target(m, registered(m, frame, registration.transform), noise);
  if (target.empty()) {
    j["status"] = "failed", j["message"] = frame.note;
    return j;
  }
  Prior prior;
  prior.head_pose = head_pose_of(registration);
  infer.model_error = ModelError().of_another_speaker();
  const Answer a = infer_from_starts(m, target, prior, ws, infer);
  if (a.status == InferStatus::converged) start_from(a, infer);
  j["status"] = to_string(a.status), j["verdict"] = to_string(a.verdict), j["message"] = a.message;
  j["rms_mm"] = 1e3 * a.rms, j["max_mm"] = 1e3 * a.max;
  j["wall_s"] = a.wall_s, j["factorizations"] = a.factorizations;
  for (const auto& c : a.muscles) j["forces_N"][c.name] = c.best;
  return j;
}

Json run_ultrasound(const BenchOptions& o, const Progress& progress) {
  const Model m = read_model(o.model);
  SessionFile target = read_session_file(o.target, {});
  const SessionFile palate = read_palate(o.palate, {}, target);
  const AlignedRecording aligned = align(m, std::move(target), palate, {});
  const ContourFile& file = aligned.file;
  const Registration& r = aligned.registration;
  InferWorkspace ws(m);
  Json frames = Json::array();
  std::vector<double> rms, seconds;
  int empty = 0;
  std::map<std::string, int> verdicts;
  InferOptions infer;
  for (const ContourFrame* frame : o.all ? every_frame(file) : middle_frames(file)) {
    if (!o.all) infer = {};
    Json j = answer_frame(m, *frame, r, file.format.noise, ws, infer);
    ++verdicts[j["status"] == "converged" ? j["verdict"].get<std::string>() : "no answer"];
    if (progress)
      progress(fmt::format("{:>5}  {:<28} {:<10} {:<12} {:5.2f} mm {:6.2f} s  {}", frame->number,
                           frame->label, j["status"].get<std::string>(), j.value("verdict", ""),
                           j.value("rms_mm", 0.0), j.value("wall_s", 0.0),
                           j["message"].get<std::string>()));
    if (j["status"] == "converged") rms.push_back(j["rms_mm"]);
    if (j.contains("wall_s")) seconds.push_back(j["wall_s"]);
    empty += frame->points.empty();
    frames.push_back(std::move(j));
  }
  const auto median = [](std::vector<double> v) {
    std::sort(v.begin(), v.end());
    return v.empty() ? Json() : Json(0.5 * (v[(v.size() - 1) / 2] + v[v.size() / 2]));
  };
  return {{"cases", frames.size()},
          {"verdicts", verdicts},
          {"empty_frames", empty},
          {"answered", rms.size()},
          {"rms_mm_median", median(rms)},
          {"wall_s_median", median(seconds)},
          {"scale", r.transform.scale},
          {"palate_rms_mm", 1e3 * r.palate_rms},
          {"frames", frames}};
}

}  // namespace

Benchmark ultrasound_bench() {
  return {.name = "ultrasound",
          .about = "A recording, one frame a word or all, registered by its palate trace",
          .options = {{"--target", "contours, one label a word", true},
                      {"--palate", "palate trace of the same session", true},
                      {"--all", "every frame, not one a word"}},
          .run = run_ultrasound};
}

}  // namespace genio::bench
