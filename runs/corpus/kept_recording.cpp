#include "runs/corpus/kept_recording.hpp"

#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "forward/base/text_file.hpp"

namespace genio {
namespace {

using Json = nlohmann::json;

std::string kept_text(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

/// JSON has no number that is none.
double kept_number(const Json& json) { return json.is_null() ? std::nan("") : json.get<double>(); }

Json kept_vector(const Vec3& v) { return {v[0], v[1], v[2]}; }

Vec3 kept_vector_of(const Json& json) {
  return {kept_number(json.at(0)), kept_number(json.at(1)), kept_number(json.at(2))};
}

Json kept_json(const ContourFrame& frame) {
  Json points = Json::array();
  for (const ContourPoint& p : frame.points)
    points.push_back(
        {kept_vector(p.position), p.sigma, p.kind, kept_vector(p.rest), p.slice, p.widening});
  return {{"frame", frame.number},          {"label", frame.label},       {"time_s", frame.time_s},
          {"recording", frame.recording},   {"speaker", frame.speaker},   {"note", frame.note},
          {"registered", frame.registered}, {"points", std::move(points)}};
}

ContourFrame kept_frame_of(const Json& json) {
  ContourFrame frame;
  json.at("frame").get_to(frame.number), json.at("label").get_to(frame.label);
  frame.time_s = kept_number(json.at("time_s"));
  json.at("recording").get_to(frame.recording), json.at("speaker").get_to(frame.speaker);
  json.at("note").get_to(frame.note), json.at("registered").get_to(frame.registered);
  for (const Json& p : json.at("points"))
    frame.points.push_back({kept_vector_of(p.at(0)), kept_number(p.at(1)),
                            p.at(2).get<std::string>(), kept_vector_of(p.at(3)), p.at(4).get<int>(),
                            kept_number(p.at(5))});
  return frame;
}

[[noreturn]] void refuse_kept(const std::string& path, const std::string& why) {
  throw InputError(
      fmt::format("{}: {}; remove its folder, and --resume reads the recording again", path, why));
}

}  // namespace

void keep_recording(const Measured& m, const std::vector<std::string>& remarks,
                    const std::string& folder) {
  make_folder(folder);
  Json json{{"noise_m", m.noise},
            {"registration", registration_json(m.registration)},
            {"forced", m.registration.forced},
            {"remarks", remarks},
            {"head_pose", nullptr}};
  if (m.head_pose)
    json["head_pose"] = {{"shift_sd_m", m.head_pose->shift_sd}, {"turn_sd", m.head_pose->turn_sd}};
  std::string lines;
  for (const ContourFrame& frame : m.frames) lines += kept_text(kept_json(frame));
  write_text(folder + "/frames.jsonl", lines);
  write_text(folder + "/recording.json", kept_text(json));
}

KeptRecording kept_recording(const std::string& folder) {
  const std::string path = folder + "/recording.json";
  std::ifstream in(path);
  if (!in) refuse_kept(path, "no such file");
  try {
    const Json json = Json::parse(in);
    KeptRecording kept;
    json.at("noise_m").get_to(kept.noise), json.at("forced").get_to(kept.forced);
    json.at("remarks").get_to(kept.remarks);
    kept.registration = json.at("registration").dump();
    if (const Json& pose = json.at("head_pose"); !pose.is_null())
      kept.head_pose = HeadPosePrior{pose.at("shift_sd_m"), pose.at("turn_sd")};
    return kept;
  } catch (const Json::exception& e) {
    refuse_kept(path, fmt::format("is damaged ({})", e.what()));
  }
}

std::vector<ContourFrame> kept_frames(const std::string& folder, int first, int end) {
  const std::string path = folder + "/frames.jsonl";
  std::ifstream in(path);
  if (!in) refuse_kept(path, "no such file");
  std::vector<ContourFrame> frames;
  std::string line;
  for (int k = 0; k < end && std::getline(in, line); ++k) {
    if (k < first) continue;
    try {
      frames.push_back(kept_frame_of(Json::parse(line)));
    } catch (const Json::exception& e) {
      refuse_kept(fmt::format("{}:{}", path, k + 1), fmt::format("is damaged ({})", e.what()));
    }
  }
  if (int(frames.size()) != end - first) refuse_kept(path, "lacks frames");
  return frames;
}

}  // namespace genio
