#include "bench/figures/forward/deformation_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace genio::bench {
namespace {

constexpr double apart_relative = 0.1, apart_mm = 1;

double most_moved_mm(const Model& m, const Equilibrium& e) {
  const Vector u = e.x - m.rest;
  return 1e3 * u.reshaped(3, u.size() / 3).colwise().norm().maxCoeff();
}

/// Of one shape; null where it was not found.
Json shape_json(const Model& m, const Equilibrium& e) {
  if (!e) return nullptr;
  const int tip = m.landmarks.tip;
  const Vec3 moved = 1e3 * (node_position(e.x, tip) - node_position(m.rest, tip));
  const ElementQuality quality = element_quality(m, e.x);
  return {{"largest_mm", most_moved_mm(m, e)},
          {"tip_mm", moved.norm()},
          {"tip_dx_mm", moved[0]},
          {"tip_dz_mm", moved[2]},
          {"volume_percent", 100 * quality.volume},
          {"least_corner_ratio", quality.least_ratio},
          {"folded_elements", quality.folded}};
}

Json difference_json(const Model& m, const Equilibrium& large, const Equilibrium& small) {
  if (!large || !small) return nullptr;
  const ShapeDifference d = difference(m, large.x, small.x);
  return {{"rms_mm", 1e3 * d.rms}, {"largest_mm", 1e3 * d.largest}, {"relative", d.relative}};
}

/// Where the values of a key of this difference first reach the bound [N].
Json reached(const std::vector<Json>& rows, const char* which, const char* key, double bound) {
  std::vector<double> forces, values;
  for (const Json& row : rows)
    if (!row[which].is_null()) forces.push_back(row["force_N"]), values.push_back(row[which][key]);
  const double force = first_reached(forces, values, bound);
  return std::isfinite(force) ? Json(force) : Json();
}

Json limits_of(const std::vector<Json>& rows, const char* which) {
  return {{"ten_percent_N", reached(rows, which, "relative", apart_relative)},
          {"one_mm_N", reached(rows, which, "largest_mm", apart_mm)}};
}

std::string number(const Json& of, const char* key, int width, int digits, double times = 1) {
  if (of.is_null()) return fmt::format("{:>{}}", "-", width);
  return fmt::format("{:{}.{}f}", times * of[key].get<double>(), width, digits);
}

std::string difference_text(const Json& d) {
  return number(d, "rms_mm", 9, 3) + number(d, "largest_mm", 9, 3) +
         number(d, "relative", 8, 1, 100) + " %";
}

std::string row_text(const Json& r) {
  const Json &large = r["large"], &small = r["small"];
  std::string line =
      fmt::format("{:<6}{:>7.4g}", r["muscle"].get<std::string>(), r["force_N"].get<double>());
  for (const char* key : {"largest_mm", "tip_mm"})
    line += number(large, key, 9, 3) + number(small, key, 9, 3);
  line += difference_text(r["difference"]) + difference_text(r["difference_without_contact"]) +
          number(small, "volume_percent", 8, 2) + number(small, "least_corner_ratio", 7, 2) +
          number(small, "folded_elements", 6, 0) + number(large, "folded_elements", 6, 0);
  for (const auto& [contact, force] : r["presses_N"].items())
    line += fmt::format("  {} {:.2g} N", contact, force.get<double>());
  const std::string message = r["message"];
  return line + (message.empty() ? "" : "  " + message) + "\n";
}

std::string limit_text(const Json& force, const Json& limits) {
  const double first = limits["first_N"], last = limits["last_N"];
  if (force.is_null()) return fmt::format("> {:.3g}", last);
  if (force == 0.0) return fmt::format("< {:.3g}", first);
  return fmt::format("{:.2g}", force.get<double>());
}

}  // namespace

Json deformation_json(const Model& m, const DeformationRow& row) {
  return {
      {"muscle", row.muscle},
      {"force_N", row.force},
      {"status", row.large && row.small && row.lone ? "converged" : "failed"},
      {"message", row.large ? row.lone ? row.small.message : row.lone.message : row.large.message},
      {"presses_N", row.pressing},
      {"large", shape_json(m, row.large)},
      {"large_without_contact", shape_json(m, row.lone)},
      {"small", shape_json(m, row.small)},
      {"difference", difference_json(m, row.large, row.small)},
      {"difference_without_contact", difference_json(m, row.lone, row.small)}};
}

Json deformation_limits(const std::vector<Json>& rows) {
  const auto touching = std::find_if(rows.begin(), rows.end(),
                                     [](const Json& row) { return !row["presses_N"].empty(); });
  return {{"muscle", rows.front()["muscle"]},
          {"first_N", rows.front()["force_N"]},
          {"last_N", rows.back()["force_N"]},
          {"touches_from_N", touching == rows.end() ? Json() : (*touching)["force_N"]},
          {"as_it_is", limits_of(rows, "difference")},
          {"without_contact", limits_of(rows, "difference_without_contact")}};
}

std::string deformation_text(const Json& result) {
  std::string text = fmt::format(
      "{}, large and small deformation; without contact once more\n\n"
      "{:13}{:^18}{:^18}{:^28}{:^28}{:^21}{:>6}\n"
      "{:<6}{:>7}{:>9}{:>9}{:>9}{:>9}{:>9}{:>9}{:>10}{:>9}{:>9}{:>10}{:>8}{:>7}{:>6}{:>6}  {}\n",
      result["model"].get<std::string>(), "", "moved at most [mm]", "tip moved [mm]", "apart [mm]",
      "without contact [mm]", "small", "large", "muscle", "N/side", "large", "small", "large",
      "small", "rms", "most", "rms", "rms", "most", "rms", "volume", "ratio", "fold", "fold",
      "presses");
  for (const Json& row : result["rows"]) text += row_text(row);
  text += fmt::format("\n{:<8}{:>10}{:>10}{:>14}{:>10}{:>14}\n", "apart by", "10 %", "1 mm",
                      "alone: 10 %", "1 mm", "touches from");
  for (const Json& l : result["limits"]) {
    text += fmt::format("{:<8}", l["muscle"].get<std::string>());
    for (const auto& [which, width] : {std::pair{"as_it_is", 10}, {"without_contact", 14}})
      text += fmt::format("{:>{}}{:>10}", limit_text(l[which]["ten_percent_N"], l), width,
                          limit_text(l[which]["one_mm_N"], l));
    const Json& touches = l["touches_from_N"];
    text += fmt::format("{:>14}\n",
                        touches.is_null() ? "-" : fmt::format("{:.3g}", touches.get<double>()));
  }
  return text;
}

}  // namespace genio::bench
