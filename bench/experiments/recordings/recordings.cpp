#include "bench/experiments/recordings/recordings.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

#include "bench/experiments/recordings/spoil.hpp"
#include "bench/truths/calibration_count.hpp"
#include "forward/model/build_model.hpp"
#include "forward/model/model_file.hpp"
#include "inverse/recording/frame_target.hpp"
#include "inverse/search/multi_start.hpp"

namespace genio::bench {
namespace {

namespace fs = std::filesystem;

/// How one recording ended, as its owner sees it.
struct Outcome {
  bool refused = false, explained = false;
  std::string said;  ///< the refusal, or the remarks
  Answer answer = {};
  std::vector<ContourPoint> placed = {};  ///< points of the first frame where registered
  double place_sd = 0;                    ///< the stated one, along an axis [m]
};

/// Distance of the placed points from where they were on the model, root mean square [m].
std::optional<double> misplaced(const Outcome& o, const std::vector<Vec2>& truth) {
  if (o.placed.empty() || o.placed.size() != truth.size()) return std::nullopt;
  double sum = 0;
  for (size_t k = 0; k < truth.size(); ++k)
    sum += (Vec2(o.placed[k].position[0], o.placed[k].position[2]) - truth[k]).squaredNorm();
  return std::sqrt(sum / double(truth.size()));
}

/// Read, registered and its first frame inverted, as `genio invert` does.
Outcome invert(const Model& model, WrittenSession w, const std::string& folder,
               InferWorkspace& ws) {
  const auto write = [&](const std::string& name, const std::string& text) {
    std::ofstream(folder + "/" + name, std::ios::binary) << text;
    return folder + "/" + name;
  };
  w.options.target = write(w.target, w.target_text);
  if (!w.palate.empty()) w.options.palate = write(w.palate, w.palate_text);
  Outcome outcome;
  try {
    const Measured m = read_measured(
        w.options, [&]() -> const Model& { return model; },
        [&](const std::string& remark) { outcome.said += remark + "\n"; });
    const ContourFrame& frame = m.frames.front();
    outcome.said += frame.note;
    outcome.placed = frame.points;
    const Target target = make_target(model, frame, m.noise);
    if (target.empty()) return outcome;
    Prior prior;
    prior.head_pose = m.head_pose;
    InferOptions options;
    if (m.head_pose) outcome.place_sd = m.head_pose->shift_sd;
    if (m.head_pose) options.model_error = ModelError().of_another_speaker();
    outcome.answer = infer_from_starts(model, target, prior, ws, options);
    outcome.explained = outcome.answer.status == InferStatus::converged &&
                        outcome.answer.verdict == Verdict::explained;
  } catch (const std::exception& e) {
    outcome.refused = true, outcome.said = e.what();
  }
  return outcome;
}

/// Warnings say what was left out or is doubtful; other remarks say what was taken for granted.
bool warned(const std::string& said) {
  for (const char* word : {"left out", "dropped", "missing", "DOUBTFUL", "not the model's"})
    if (said.find(word) != std::string::npos) return true;
  return false;
}

Json run_recordings(const BenchOptions& o, const Progress& progress) {
  const Model model = read_model(o.model);
  const int count = o.sample > 0 ? o.sample : 200;
  const std::string folder =
      (fs::temp_directory_path() / fmt::format("genio_recordings_{}", getpid())).string();
  fs::create_directories(folder);
  InferWorkspace ws(model);
  std::mt19937 random(o.seed);
  constexpr std::pair<Device, const char*> devices[] = {{Device::aaa, "aaa"},
                                                        {Device::edgetrak, "edgetrak"},
                                                        {Device::articulograph, "articulograph"},
                                                        {Device::getcontours, "getcontours"},
                                                        {Device::table, "table"}};
  int good_refused = 0, good_explained = 0, spoiled = 0, spoiled_explained = 0, unnamed = 0,
      unnamed_harmed = 0;
  Json refusals = Json::array(), missed = Json::array();
  std::map<std::string, CalibrationCount> truths;
  std::map<std::string, std::array<int, 3>> kinds;  // cases, explained, unnamed
  for (int k = 0; k < count; ++k) {
    const auto& device = devices[k % 5];
    const SyntheticSession session = draw_session(model, device.first, random);
    const Outcome good = invert(model, written(session), folder, ws);
    good_refused += good.refused, good_explained += good.explained;
    if (good.answer.status == InferStatus::converged)
      truths[device.second].add(good.answer.muscles, session.forces.front(), good.answer.verdict,
                                good.answer.rms);
    if (good.refused) refusals.push_back({{"session", k}, {"said", good.said}});
    const Spoil& spoil = spoils()[size_t(k / 5) % spoils().size()];
    SyntheticSession bad = session;
    if (spoil.before && !spoil.before(bad, model, random)) continue;
    WrittenSession text = written(bad);
    if (spoil.after && !spoil.after(text, random)) continue;
    const Outcome outcome = invert(model, std::move(text), folder, ws);
    const bool silent = outcome.explained && !warned(outcome.said);
    ++spoiled, spoiled_explained += outcome.explained, unnamed += silent;
    auto& kind = kinds[spoil.name];
    ++kind[0], kind[1] += outcome.explained, kind[2] += silent;
    if (silent) {
      Json entry = {
          {"session", k}, {"device", k % 5}, {"spoil", spoil.name}, {"said", outcome.said}};
      const auto off = misplaced(outcome, bad.frames.front());
      // Within twice what the answer says of its place the spoiling did no harm.
      const bool harmed = !off || *off > 2 * std::sqrt(2.0) * outcome.place_sd;
      if (off) entry["place_off_mm"] = 1e3 * *off;
      entry["place_sd_mm"] = 1e3 * outcome.place_sd, entry["harmed"] = harmed;
      unnamed_harmed += harmed;
      missed.push_back(std::move(entry));
    }
    if (progress)
      progress(fmt::format("{:>4}  {:<24} {}", k, spoil.name,
                           outcome.refused     ? "refused"
                           : outcome.explained ? silent ? "EXPLAINED" : "explained, with a warning"
                                               : "answered, not explained"));
  }
  fs::remove_all(folder);
  Json by_kind;
  for (const auto& [name, n] : kinds)
    by_kind[name] = {{"cases", n[0]}, {"explained", n[1]}, {"unnamed", n[2]}};
  Json intervals;
  for (const auto& [device, counted] : truths) intervals[device] = counted.json();
  return {{"good", count},
          {"good_refused", good_refused},
          {"good_explained", good_explained},
          {"spoiled", spoiled},
          {"spoiled_explained", spoiled_explained},
          {"spoiled_unnamed", unnamed},
          {"spoiled_unnamed_and_misplaced", unnamed_harmed},
          {"by_kind", by_kind},
          {"intervals", intervals},
          {"refusals", refusals},
          {"missed", missed}};
}

}  // namespace

Benchmark recordings_bench() {
  return {
      .name = "recordings",
      .about = "Recordings of the model itself, each also spoiled in one way: refused or named?",
      .options = {{"--sample", "sessions (200)"}, {"--seed", "which are drawn"}},
      .run = run_recordings};
}

}  // namespace genio::bench
