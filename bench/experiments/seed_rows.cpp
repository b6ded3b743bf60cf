#include "bench/experiments/seed_rows.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace genio::bench {
namespace {

const double words_only = std::nan("");

/// How much deeper the middle of the blade lies than its sides [mm]; `u`: what moved [mm].
double groove_depth(const Model& m, const Vector& u) {
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
  return middle_count && side_count ? sides / side_count - middle / middle_count : 0;
}

}  // namespace

const std::vector<PrintedRow>& printed_rows() {
  static const std::vector<PrintedRow> all = {
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

std::map<std::string, double> measured_moves(const Model& m, const Positions& x) {
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
  r["rear_forward_mm"] = forward, r["rear_back_mm"] = back, r["rear_down_mm"] = down;
  r["dorsum_up_mm"] = up;
  r["tip_dx_mm"] = u[3 * m.landmarks.tip], r["tip_dz_mm"] = u[3 * m.landmarks.tip + 2];
  r["groove_mm"] = groove_depth(m, u);
  return r;
}

Json compared(const PrintedRow& row, const std::map<std::string, double>& moves) {
  Json list = Json::array();
  for (const PrintedResult& p : row.printed) {
    const double value = moves.at(p.measure);
    Json j = {{"measure", p.measure}, {"paper", p.words}, {"ours_mm", value}};
    if (std::isnan(p.value)) j["agrees"] = value * p.sign > 0;
    else j["deviation_mm"] = value - p.value;
    list.push_back(std::move(j));
  }
  return list;
}

}  // namespace genio::bench
