#include "bench/experiments/seed_suite.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>

#include "forward/effects/muscles/muscles.hpp"
#include "forward/model/build_model.hpp"
#include "forward/statics/equilibrium.hpp"
#include "report/shape_picture.hpp"
#include "report/svg.hpp"

namespace genio {
namespace {

using Json = nlohmann::json;

struct Printed {
  const char *measure, *words;
  double value;  ///< [mm]; NaN where the paper gives a direction only
  int sign;      ///< of that direction
};

struct Row {
  const char* name;
  std::vector<std::pair<const char*, double>> forces;  ///< as printed [N]
  std::vector<Printed> printed;
};

const double words_only = std::nan("");

const std::vector<Row>& rows() {
  static const std::vector<Row> all = {
      {"GGP", {{"GGP", 2}}, {{"rear_forward_mm", "20", 20, 1}, {"dorsum_up_mm", "9", 9, 1}}},
      {"GGP+TRANS", {{"GGP", 2}, {"TRANS", 0.1}}, {{"dorsum_up_mm", "13", 13, 1}}},
      {"GGA",
       {{"GGA", 0.5}},
       {{"tip_dz_mm", "slightly down", words_only, -1},
        {"groove_mm", "groove behind the tip", words_only, 1}}},
      {"HG", {{"HG", 1}}, {{"rear_down_mm", "12", 12, 1}, {"rear_back_mm", "back", words_only, 1}}},
      {"STY",
       {{"STY", 1}},
       {{"dorsum_up_mm", "up", words_only, 1},
        {"tip_dz_mm", "down", words_only, -1},
        {"tip_dx_mm", "back", words_only, 1}}}};
  return all;
}

/// What moved [mm]: of the midsagittal line's rear (behind the dorsum) and top (within 15 mm of the
/// dorsum), of the tip, and how much deeper the middle of the blade lies than its sides.
std::map<std::string, double> measures(const Model& m, const Positions& x) {
  const Vector u = 1e3 * (x - m.rest);
  std::map<std::string, double> r;
  bool rear = false;
  double forward = 0, back = 0, down = 0, up = 0;
  const double top = m.mesh.nodes[size_t(m.landmarks.dorsum)][0];
  for (int n : m.midsagittal) {
    rear |= n == m.landmarks.dorsum;
    if (std::abs(m.mesh.nodes[size_t(n)][0] - top) < 0.015) up = std::max(up, u[3 * n + 2]);
    if (!rear) continue;
    forward = std::max(forward, -u[3 * n]), back = std::max(back, u[3 * n]);
    down = std::max(down, -u[3 * n + 2]);
  }
  const Vec3 tip = m.mesh.nodes[size_t(m.landmarks.tip)];
  double middle = 0, sides = 0;
  int middle_count = 0, side_count = 0;
  for (const Quad& face : m.surface) {
    const Vec3 normal = Vec3(m.mesh.nodes[size_t(face[2])] - m.mesh.nodes[size_t(face[0])])
                            .cross(m.mesh.nodes[size_t(face[3])] - m.mesh.nodes[size_t(face[1])])
                            .normalized();
    if (normal[2] < 0.5) continue;
    for (int n : face) {
      const Vec3& at = m.mesh.nodes[size_t(n)];
      if (at[0] < tip[0] + 0.006 || at[0] > tip[0] + 0.025) continue;
      if (std::abs(at[1]) < 2e-3) middle += u[3 * n + 2], ++middle_count;
      if (std::abs(at[1]) > 8e-3) sides += u[3 * n + 2], ++side_count;
    }
  }
  r["rear_forward_mm"] = forward, r["rear_back_mm"] = back, r["rear_down_mm"] = down;
  r["dorsum_up_mm"] = up;
  r["tip_dx_mm"] = u[3 * m.landmarks.tip], r["tip_dz_mm"] = u[3 * m.landmarks.tip + 2];
  r["groove_mm"] = middle_count && side_count ? sides / side_count - middle / middle_count : 0;
  return r;
}

Model variant(const ModelDescription& tongue, const std::string& source, bool cadaver, bool palate,
              bool jaw) {
  ModelDescription d = tongue;
  if (cadaver) d.effects["elasticity"] = {{"a10", 192}, {"a20", 90}, {"kappa", 192000}};
  else d.effects["elasticity"] = {{"a10", 1037}, {"a20", 486}, {"kappa", 1037000}};
  if (!palate) d.effects.erase("palate_contact");
  if (!jaw) d.effects.erase("jaw_contact");
  return build_model(d, source);
}

void write_picture(const std::string& path, const std::string& svg) {
  write_text(path + ".svg", svg);
  write_png(path + ".png", svg, 1);
}

Json compared(const Row& row, const std::map<std::string, double>& moved) {
  Json list = Json::array();
  for (const Printed& p : row.printed) {
    const double value = moved.at(p.measure);
    Json j = {{"measure", p.measure}, {"paper", p.words}, {"ours_mm", value}};
    if (std::isnan(p.value)) j["agrees"] = value * p.sign > 0;
    else j["deviation_mm"] = value - p.value;
    list.push_back(std::move(j));
  }
  return list;
}

/// Angles between neighbouring faces of the tongue's own surface [deg].
std::vector<double> edge_angles(const Model& m, const Positions& x) {
  std::map<std::pair<int, int>, std::vector<Vec3>> edges;
  for (const Quad& f : m.surface) {
    if (std::any_of(f.begin(), f.end(),
                    [&](int n) { return m.supports[size_t(n)] != Support::free; }))
      continue;
    const Vec3 normal = Vec3(node_position(x, f[2]) - node_position(x, f[0]))
                            .cross(Vec3(node_position(x, f[3]) - node_position(x, f[1])))
                            .normalized();
    for (size_t i = 0; i < 4; ++i) edges[std::minmax(f[i], f[(i + 1) % 4])].push_back(normal);
  }
  std::vector<double> angles;
  for (const auto& [edge, normals] : edges)
    if (normals.size() == 2)
      angles.push_back(180 / M_PI * std::acos(std::clamp(normals[0].dot(normals[1]), -1.0, 1.0)));
  return angles;
}

/// How much sharper than at rest the surface's edges became [deg].
Json sharpness(const Model& m, const Positions& x) {
  const auto before = edge_angles(m, m.rest);
  auto change = edge_angles(m, x);
  for (size_t i = 0; i < change.size(); ++i) change[i] -= before[i];
  std::sort(change.begin(), change.end());
  return {{"largest_deg", change.back()}, {"p99_deg", change[change.size() * 99 / 100]}};
}

/// STY with its forces concentrated as the seed model has them, every fibre pulling with the same
/// tension along its whole length and so at its ends only, and distributed by tissue volume.
Json styloglossus(const ModelDescription& tongue, const std::string& source,
                  const std::string& folder) {
  const Model ours = variant(tongue, source, true, true, true);
  ModelParts parts = ours.parts();
  for (Muscle& muscle : parts.muscles)
    if (bilateral_name(muscle.name) == "STY")
      for (auto& s : muscle.segments) s.share = 1.0 / double(muscle.fibres.size());
  for (Effect& effect : parts.effects)
    if (effect.commands) effect = muscle_commands(parts.muscles);
  const Model seed(std::move(parts));
  Json j;
  for (const auto& [name, model] :
       {std::pair<const char*, const Model*>{"concentrated", &seed}, {"distributed", &ours}}) {
    Parameters p = default_parameters(*model);
    set_command(*model, "STY", 2, p);
    Workspace ws(*model);
    const Equilibrium e = solve_equilibrium(*model, p, model->rest, ws);
    if (!e) {
      j[name] = {{"status", "failed"}, {"message", e.message}};
      continue;
    }
    j[name] = sharpness(*model, e.x);
    if (!folder.empty())
      write_picture(folder + "/STY_" + name,
                    draw_shape(*model, e.x, fmt::format("STY 1 N a side, {} forces", name)));
  }
  return j;
}

}  // namespace

Json seed_suite(const ModelDescription& tongue, const std::string& source,
                const std::string& folder,
                const std::function<void(const std::string&)>& progress) {
  if (!folder.empty()) std::filesystem::create_directories(folder);
  Json list = Json::array();
  std::string csv =
      "row,law,forces,contact,status,rear_forward_mm,rear_back_mm,rear_down_mm,dorsum_up_mm,"
      "tip_dx_mm,tip_dz_mm,groove_mm,volume_percent,penetration_mm,message\n";
  for (const bool cadaver : {true, false})
    for (const auto& [contact, palate, jaw] : {std::tuple{"off", false, false},
                                               {"palate", true, false},
                                               {"jaw", false, true},
                                               {"both", true, true}}) {
      const Model m = variant(tongue, source, cadaver, palate, jaw);
      Workspace ws(m);
      for (const bool per_side : {true, false})
        for (const Row& row : rows()) {
          Parameters p = default_parameters(m);
          for (const auto& [muscle, newtons] : row.forces)
            set_command(m, muscle, per_side ? 2 * newtons : newtons, p);
          const Equilibrium e = solve_equilibrium(m, p, m.rest, ws);
          Json j = {{"row", row.name},
                    {"law", cadaver ? "cadaver" : "living"},
                    {"forces", per_side ? "per side" : "in all"},
                    {"contact", contact},
                    {"status", e ? "converged" : "failed"},
                    {"message", e.message}};
          std::string line = fmt::format("{:<10} {:<8} {:<9} contact {:<7}", row.name,
                                         cadaver ? "cadaver" : "living",
                                         per_side ? "per side" : "in all", contact);
          if (e) {
            const auto moved = measures(m, e.x);
            for (const auto& [name, value] : moved) j[name] = value;
            j["volume_percent"] =
                100 * (mesh_volume(m.mesh, e.x) / mesh_volume(m.mesh, m.rest) - 1);
            j["max_penetration_mm"] = 1e3 * max_penetration(m, e.x, p);
            j["paper"] = compared(row, moved);
            for (const Json& c : j["paper"])
              line += fmt::format("  {} {:.1f} (paper {})", c["measure"].get<std::string>(),
                                  c["ours_mm"].get<double>(), c["paper"].get<std::string>());
            csv += fmt::format("{},{},{},{},converged", row.name, cadaver ? "cadaver" : "living",
                               per_side ? "per side" : "in all", contact);
            for (const char* name : {"rear_forward_mm", "rear_back_mm", "rear_down_mm",
                                     "dorsum_up_mm", "tip_dx_mm", "tip_dz_mm", "groove_mm"})
              csv += fmt::format(",{:.3f}", moved.at(name));
            csv += fmt::format(",{:.4f},{:.4f},\n", j["volume_percent"].get<double>(),
                               j["max_penetration_mm"].get<double>());
            if (!folder.empty() && per_side && (palate == jaw))
              write_picture(fmt::format("{}/{}_{}_contact_{}", folder, row.name,
                                        cadaver ? "cadaver" : "living", contact),
                            draw_shape(m, e.x, line));
          } else {
            line += "  " + e.message;
            csv += fmt::format("{},{},{},{},failed,,,,,,,,,,{}\n", row.name,
                               cadaver ? "cadaver" : "living", per_side ? "per side" : "in all",
                               contact, e.message);
          }
          if (progress) progress(line);
          list.push_back(std::move(j));
        }
    }
  Json result = {{"model", tongue.name}, {"rows", list}};
  result["styloglossus_edges"] = styloglossus(tongue, source, folder);
  if (!folder.empty()) {
    write_text(folder + "/suite.json", result.dump(2) + "\n");
    write_text(folder + "/suite.csv", csv);
  }
  return result;
}

}  // namespace genio
