#include "inverse/recording/samples/sensor_channels.hpp"

#include <algorithm>
#include <cctype>
#include <limits>
#include <map>

namespace genio {
namespace {

bool cut_tail(std::string& name, const std::string& tail) {
  if (name.size() <= tail.size()) return false;
  const std::string end = name.substr(name.size() - tail.size());
  if (!std::equal(end.begin(), end.end(), tail.begin(),
                  [](unsigned char a, char b) { return std::tolower(a) == b; }))
    return false;
  name.resize(name.size() - tail.size());
  return true;
}

/// "tt_posy" -> ("tt", 1); axis -1 where it is no position.
std::pair<std::string, int> coordinate(std::string name) {
  for (const char* unit : {"[cm]", "[mm]", "[m]"}) cut_tail(name, unit);
  cut_tail(name, "_raw");
  for (int axis = 0; axis < 3; ++axis) {
    if (!cut_tail(name, std::string(1, "xyz"[axis]))) continue;
    for (const char* tail : {"_pos", "pos", "_p", "_", "-", "."})
      if (cut_tail(name, tail)) break;
    return {name, axis};
  }
  return {name, -1};
}

}  // namespace

SensorChannels::SensorChannels(const std::vector<std::string>& tracks) {
  std::map<std::string, size_t> by_stem;
  std::vector<std::string> names;
  std::vector<std::array<int, 3>> parts;
  for (size_t k = 0; k < tracks.size(); ++k) {
    const auto [stem, axis] = coordinate(tracks[k]);
    if (axis < 0) continue;
    const auto [it, fresh] = by_stem.try_emplace(stem, parts.size());
    if (fresh) names.push_back(stem), parts.push_back({-1, -1, -1});
    parts[it->second][size_t(axis)] = int(k);
  }
  for (size_t s = 0; s < parts.size(); ++s) {
    auto p = parts[s];
    if (std::count(p.begin(), p.end(), -1) > 1) continue;
    // Two are the horizontal and the vertical one, whatever they are called.
    if (p[0] < 0) p = {p[1], -1, p[2]};
    if (p[2] < 0) std::swap(p[1], p[2]);
    names_.push_back(names[s]), parts_.push_back(p);
  }
}

std::vector<Vec3> SensorChannels::positions(const std::vector<double>& values) const {
  std::vector<Vec3> row;
  for (const auto& p : parts_) {
    Vec3 v = Vec3::Zero();
    for (size_t i = 0; i < 3; ++i)
      if (p[i] >= 0) v[Eigen::Index(i)] = values[size_t(p[i])];
    row.push_back(sensor_position(v[0], v[1], v[2]));
  }
  return row;
}

Vec3 sensor_position(double x, double y, double z) {
  const Vec3 p(x, y, z);
  return p.allFinite() && !p.isZero(0) ? p
                                       : Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
}

std::vector<std::string> numbered_sensors(size_t count) {
  std::vector<std::string> names;
  for (size_t k = 1; k <= count; ++k) names.push_back(std::to_string(k));
  return names;
}

}  // namespace genio
