#include "inverse/recording/sensor_place.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "forward/base/median.hpp"
#include "forward/base/nearest_name.hpp"
#include "forward/model/at_anatomy.hpp"

namespace genio {
namespace {

constexpr double in_order = 5e-3;  // places that differ by less along the head have no order [m]
constexpr double out_of_order = 3e-3;  // of sensors that lie the other way round [m]
constexpr double glue_slack = 3e-3;    // of gluing and of the line's chords [m]
constexpr double first_behind = 0.01;  // where the first sensor sits, 5 to 15 mm behind the tip [m]
constexpr size_t most_frames = 2000;   // that are looked at

/// Arc lengths of the line's nodes behind the tip [m]; negative on the tongue's underside.
std::vector<double> arcs(const Model& model) {
  const auto& line = model.midsagittal;
  const auto here = at_anatomy(model);
  const std::vector<Vec3>& nodes = here->mesh.nodes;
  std::vector<double> s(line.size(), 0.0);
  for (size_t k = 1; k < line.size(); ++k)
    s[k] = s[k - 1] + (nodes[size_t(line[k])] - nodes[size_t(line[k - 1])]).norm();
  const auto tip = std::find(line.begin(), line.end(), model.landmarks.tip);
  const double at = tip == line.end() ? 0 : s[size_t(tip - line.begin())];
  for (double& v : s) v -= at;
  return s;
}

std::vector<std::pair<int, double>> at_arc(const Model& model, double arc,
                                           const std::string& place) {
  const auto s = arcs(model);
  if (s.size() < 2 || !(arc >= s.front() && arc <= s.back()))
    throw InputError(fmt::format(
        "place '{}' is {:.1f} mm behind the tip; the tongue's line runs from {:.1f} to {:.1f} mm",
        place, 1e3 * arc, s.empty() ? 0 : 1e3 * s.front(), s.empty() ? 0 : 1e3 * s.back()));
  const auto next = std::clamp<size_t>(
      size_t(std::upper_bound(s.begin(), s.end(), arc) - s.begin()), 1, s.size() - 1);
  const double t = (arc - s[next - 1]) / (s[next] - s[next - 1]);
  const auto& line = model.midsagittal;
  if (t < 1e-9) return {{line[next - 1], 1.0}};
  if (t > 1 - 1e-9) return {{line[next], 1.0}};
  return {{line[next - 1], 1 - t}, {line[next], t}};
}

int landmark(const Model& model, const std::string& name) {
  if (name == "tip") return model.landmarks.tip;
  if (name == "dorsum") return model.landmarks.dorsum;
  if (name == "root") return model.landmarks.root;
  if (name == "blade") {  // a third of the way from tip to dorsum along the line
    const auto& line = model.midsagittal;
    const auto tip = std::find(line.begin(), line.end(), model.landmarks.tip) - line.begin();
    const auto top = std::find(line.begin(), line.end(), model.landmarks.dorsum) - line.begin();
    return line[size_t(tip + (top - tip + 1) / 3)];
  }
  if (name.starts_with("node:")) {
    char* end = nullptr;
    const long n = std::strtol(name.c_str() + 5, &end, 10);
    if (name.size() > 5 && !*end && n >= 0 && n < long(model.mesh.nodes.size())) return int(n);
    throw InputError(
        fmt::format("kind '{}': expected node:0 to node:{}", name, model.mesh.nodes.size() - 1));
  }
  throw InputError(fmt::format("kind or place '{}': unknown; did you mean {}?", name,
                               nearest_name(name, {"curve", "surface", "volume", "tip", "blade",
                                                   "dorsum", "root", "node:0", "tip+10mm"})));
}

/// "tip+13mm" -> ("tip", 0.013).
std::pair<std::string, double> parts(const std::string& place) {
  const auto sign = place.find_first_of("+-");
  if (sign == std::string::npos) return {place, 0};
  char* end = nullptr;
  const double length = std::strtod(place.c_str() + sign, &end);
  const std::string unit = end;
  if (end == place.c_str() + sign || unit != "mm" || !std::isfinite(length))
    throw InputError(fmt::format(
        "place '{}': expected a landmark and a length behind it, as in tip+13mm", place));
  return {place.substr(0, sign), 1e-3 * length};
}

double arc_of_node(const Model& model, int node) {
  const auto& line = model.midsagittal;
  const auto at = std::find(line.begin(), line.end(), node);
  return at == line.end() ? std::nan("") : arcs(model)[size_t(at - line.begin())];
}

bool glued(const ContourPoint& p) {
  return p.kind != "curve" && p.kind != "surface" && p.kind != "volume" && p.kind != "palate";
}

std::vector<std::string> kinds_of(const ContourFile& file) {
  std::vector<std::string> kinds;
  for (size_t f = 0; f < std::min(file.frames.size(), most_frames); ++f)
    for (const ContourPoint& p : file.frames[f].points)
      if (glued(p) && std::find(kinds.begin(), kinds.end(), p.kind) == kinds.end())
        kinds.push_back(p.kind);
  return kinds;
}

/// The median distance of two sensors in the plane and across, where given [m]; NaN: never seen
/// together.
double usual_distance(const ContourFile& file, const std::string& a, const std::string& b) {
  std::vector<double> distances;
  for (size_t f = 0; f < std::min(file.frames.size(), most_frames); ++f) {
    const ContourPoint *pa = nullptr, *pb = nullptr;
    for (const ContourPoint& p : file.frames[f].points) {
      if (p.kind == a) pa = &p;
      if (p.kind == b) pb = &p;
    }
    if (!pa || !pb) continue;
    Vec3 way = pa->position - pb->position;
    if (std::isnan(way[1])) way[1] = 0;
    distances.push_back(way.norm());
  }
  return distances.empty() ? std::nan("") : median(std::move(distances));
}

Vec3 at_rest(const Model& model, const std::string& place) {
  Vec3 sum = Vec3::Zero();
  for (const auto& [node, weight] : sensor_place(model, place))
    sum += weight * at_anatomy(model)->mesh.nodes[size_t(node)];
  return sum;
}

/// Two sensors that were said to be at one place, and lie apart.
std::string apart_at_one_place(const ContourFile& file) {
  for (size_t f = 0; f < std::min(file.frames.size(), most_frames); ++f) {
    const auto& points = file.frames[f].points;
    for (size_t i = 0; i < points.size(); ++i)
      for (size_t k = i + 1; k < points.size(); ++k) {
        if (!glued(points[i]) || points[i].kind != points[k].kind) continue;
        const Vec3 way = points[i].position - points[k].position;
        if (const double off = std::hypot(way[0], way[2]); off > in_order)
          return fmt::format("two sensors are said to be at {}, and lie {:.1f} mm apart",
                             points[i].kind, 1e3 * off);
      }
  }
  return {};
}

/// Where a sensor lies along the head, over all frames [m].
double mean_back(const ContourFile& file, const std::string& kind) {
  double sum = 0, count = 0;
  for (size_t f = 0; f < std::min(file.frames.size(), most_frames); ++f)
    for (const ContourPoint& p : file.frames[f].points)
      if (p.kind == kind) sum += p.position[0], ++count;
  return sum / std::max(1.0, count);
}

/// Two sensors of which the one that was said to be behind lies in front.
std::string other_order(const Model& model, const ContourFile& file) {
  const auto kinds = kinds_of(file);
  for (const std::string& front : kinds)
    for (const std::string& behind : kinds) {
      if (at_rest(model, behind)[0] - at_rest(model, front)[0] < in_order) continue;
      const double off = mean_back(file, front) - mean_back(file, behind);
      if (off > out_of_order)
        return fmt::format(
            "the sensor at {} lies {:.1f} mm in front of that at {}, and these "
            "places are the other way round",
            behind, 1e3 * off, front);
    }
  return {};
}

/// In millimetres, as many digits as tell something.
std::string length_text(double length) {
  return length < 1e-3 ? fmt::format("{:.2g}", 1e3 * length) : fmt::format("{:.1f}", 1e3 * length);
}

/// " (are its units cm? ...)" where other units would explain a distance; else empty.
std::string other_units(const std::string& units, double seen, double modelled) {
  const auto own = metres_a_unit(units);
  if (!own) return {};
  for (const char* unit : {"cm", "m", "mm", "um"})
    if (const double ratio = *metres_a_unit(unit) / *own * seen / modelled;
        unit != units && ratio > 0.5 && ratio < 2)
      return fmt::format(" (are its units {}? --units says so)", unit);
  return {};
}

/// Two sensors whose distance is not that of their places.
std::string other_distance(const Model& model, const ContourFile& file,
                           const std::pair<double, double>& scales, double stretch) {
  const auto kinds = kinds_of(file);
  std::string worst;
  double worst_ratio = 0;
  for (size_t i = 0; i < kinds.size(); ++i)
    for (size_t j = i + 1; j < kinds.size(); ++j) {
      const double seen = usual_distance(file, kinds[i], kinds[j]);
      const double modelled = (at_rest(model, kinds[i]) - at_rest(model, kinds[j])).norm();
      if (std::isnan(seen)) continue;
      const bool near = seen + glue_slack < modelled * scales.first * (1 - stretch);
      const bool far = seen - glue_slack > modelled * scales.second * (1 + stretch);
      if (!near && !far) continue;
      const double ratio = near ? modelled / (seen + 1e-4) : seen / (modelled + 1e-4);
      if (ratio <= worst_ratio) continue;
      worst_ratio = ratio;
      worst = fmt::format(
          "the sensors at {} and {} are {} mm apart, these places {:.1f} mm in the model{}",
          kinds[i], kinds[j], length_text(seen), 1e3 * modelled,
          other_units(file.units, seen, modelled));
    }
  return worst;
}

}  // namespace

std::vector<std::pair<int, double>> sensor_place(const Model& model, const std::string& place) {
  const auto [name, length] = parts(place);
  const int node = landmark(model, name);
  if (length == 0) return {{node, 1.0}};
  const double arc = arc_of_node(model, node);
  if (std::isnan(arc))
    throw InputError(fmt::format(
        "place '{}': {} is not on the tongue's midsagittal line, along which lengths are measured",
        place, name));
  return at_arc(model, arc + length, place);
}

double behind_tip(const Model& model, const std::string& place) {
  const auto [name, length] = parts(place);
  return arc_of_node(model, landmark(model, name)) + length;
}

std::map<std::string, double> places_by_distance(const Model& model, const ContourFile& file) {
  std::vector<std::string> kinds = kinds_of(file);
  std::erase_if(kinds, [&](const auto& kind) { return std::isnan(behind_tip(model, kind)); });
  std::sort(kinds.begin(), kinds.end(), [&](const auto& a, const auto& b) {
    return behind_tip(model, a) < behind_tip(model, b);
  });
  std::map<std::string, double> places;
  double arc = first_behind;
  for (size_t k = 0; k < kinds.size(); ++k) {
    if (k > 0) {
      const double step = usual_distance(file, kinds[k - 1], kinds[k]);
      arc +=
          std::isnan(step) ? behind_tip(model, kinds[k]) - behind_tip(model, kinds[k - 1]) : step;
    }
    places[kinds[k]] = arc;
  }
  return places;
}

std::string place_contradiction(const Model& model, const ContourFile& file,
                                const std::pair<double, double>& scales, double stretch) {
  std::string worst = apart_at_one_place(file);
  if (worst.empty()) worst = other_order(model, file);
  if (worst.empty()) worst = other_distance(model, file, scales, stretch);
  if (worst.empty()) return {};
  std::string proposal;
  for (const auto& [kind, arc] : places_by_distance(model, file))
    proposal += fmt::format("{}{} at tip+{:.0f}mm", proposal.empty() ? " " : ", ", kind, 1e3 * arc);
  return worst + "; give the places by their length behind the tip, as in --sensors 2=tip+13mm" +
         (proposal.empty() ? "" : ". By their distances these fit:" + proposal);
}

}  // namespace genio
