#include "cli/result_json.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "inverse/recording/sensor_place.hpp"

namespace genio::cli {
namespace {

using Json = nlohmann::json;

void add_shape(Json& j, const StaticsResult::Shape& shape) {
  j["volume_change_percent"] = shape.volume_change_percent;
  j["max_penetration_mm"] = shape.max_penetration_mm;
  j["energy_J"] = shape.energy_J;
  for (const LandmarkShift& l : shape.landmarks) {
    Json& shift = j["landmarks"][l.name];
    shift["dx_mm"] = l.mm[0], shift["dy_mm"] = l.mm[1], shift["dz_mm"] = l.mm[2];
  }
}

void add_anatomy(Json& j, const std::map<std::string, double>& values) {
  for (const auto& [mode, value] : values) j["anatomy"][mode] = value;
}

}  // namespace

std::string info_json(const Model& m, double smallest_corner_jacobian_ratio,
                      const ModelOrigin& origin) {
  Json j;
  j["name"] = m.name, j["provenance"] = origin.provenance, j["sha256"] = origin.hashes;
  j["nodes"] = m.mesh.nodes.size(), j["elements"] = m.mesh.elements.size();
  j["volume_cm3"] = 1e6 * mesh_volume(m.mesh, m.rest);
  j["min_corner_jacobian_ratio"] = smallest_corner_jacobian_ratio;
  for (const auto& muscle : m.muscles) j["muscles"][muscle.name]["max_force_N"] = muscle.max_force;
  for (const auto& p : m.parameters) {
    Json& parameter = j["effects"][p.name.effect][p.name.key];
    parameter["value"] = p.info.value, parameter["unit"] = p.info.unit;
    parameter["lower"] = p.info.lower, parameter["upper"] = p.info.upper;
  }
  for (const char* place : {"tip", "blade", "dorsum", "root"})
    j["landmarks"][place]["behind_tip_mm"] = 1e3 * behind_tip(m, place);
  for (const int n : m.midsagittal)
    j["line"].push_back({{"node", n},
                         {"x_mm", 1e3 * m.rest[3 * n]},
                         {"z_mm", 1e3 * m.rest[3 * n + 2]},
                         {"behind_tip_mm", 1e3 * behind_tip(m, fmt::format("node:{}", n))}});
  return j.dump();
}

std::string statics_json(const StaticsResult& r) {
  Json j;
  j["status"] = r.shape ? "converged" : "failed", j["message"] = r.message;
  j["newton_iterations"] = r.newton_iterations, j["factorizations"] = r.factorizations;
  j["wall_s"] = r.wall_s;
  add_anatomy(j, r.anatomy);
  if (r.shape) add_shape(j, *r.shape);
  return j.dump();
}

std::string motion_json(const MotionResult& r) {
  Json j;
  j["status"] = r.end ? "converged" : "failed", j["message"] = r.message;
  j["steps"] = r.steps, j["rejected_steps"] = r.rejected_steps;
  j["simulated_s"] = r.simulated_s;
  j["newton_iterations"] = r.newton_iterations, j["factorizations"] = r.factorizations;
  j["wall_s"] = r.wall_s;
  add_anatomy(j, r.anatomy);
  j["realtime_factor"] = r.simulated_s > 0 ? r.wall_s / r.simulated_s : 0;
  if (r.end) {
    add_shape(j, r.end->shape);
    j["rise_time_s"] = r.end->rise_time_s;
    j["kinetic_J"] = r.end->kinetic_J, j["dissipated_J"] = r.end->dissipated_J;
    j["work_J"] = r.end->work_J;
  }
  return j.dump();
}

std::string status_json(const server_status_t& s, int indent) {
  Json j;
  j["version"] = s.version;
  j["model"] = s.model.empty() ? "" : s.model.front();
  j["models"] = Json::array();
  for (size_t k = 0; k < s.model.size() && k < s.model_hash.size(); ++k)
    j["models"].push_back({{"name", s.model[k]}, {"hash", s.model_hash[k]}});
  j["queued"] = s.queued, j["running"] = s.running;
  j["workers"] = s.workers, j["replaced"] = s.replaced;
  j["received"] = s.received, j["computed"] = s.computed, j["replied"] = s.replied;
  j["refused"] = s.refused, j["failed"] = s.failed, j["cancelled"] = s.cancelled;
  j["past_deadline"] = s.past_deadline;
  j["dropped"] = {{"unreadable", s.unreadable},
                  {"unsigned", s.unsigned_dropped},
                  {"forged", s.forged_dropped},
                  {"stale", s.stale_dropped},
                  {"connections", s.hub_dropped}};
  j["hub_connections"] = s.hub_connections;
  j["latency_s"] = {{"p50", s.latency_p50_s}, {"p90", s.latency_p90_s}, {"p99", s.latency_p99_s}};
  j["memory_mb"] = s.memory_mb, j["uptime_s"] = s.uptime_s;
  return j.dump(indent);
}

}  // namespace genio::cli
