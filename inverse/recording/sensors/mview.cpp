#include "inverse/recording/sensors/mview.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "inverse/recording/base/named_curve.hpp"
#include "inverse/recording/base/table_text.hpp"
#include "inverse/recording/binary/mat_file.hpp"
#include "inverse/recording/samples/sensor_channels.hpp"
#include "inverse/recording/sensors/mview_labels.hpp"

namespace genio {
namespace {

using Kind = DataTree::Kind;

constexpr double highest_rate = 1e5;  // [Hz]

/// One element of the array that moves: sound and scalars have a single column.
struct Trajectory {
  std::string name;
  double rate = 0;                   // [Hz]
  const DataTree* signal = nullptr;  // samples by 2 or more
};

bool is_trajectories(const DataTree& v) {
  return v.kind == Kind::list && !v.children.empty() && v.children.front().find("NAME") &&
         v.children.front().find("SIGNAL");
}

const DataTree& trajectories_of(const DataTree& file, const std::string& path) {
  const DataTree* found = nullptr;
  std::string names;
  for (const DataTree& v : file.children) {
    names += (names.empty() ? "" : ", ") + in_quotes(v.name);
    if (!is_trajectories(v)) continue;
    if (found)
      throw InputError(fmt::format("{}: several recordings, {} and {}; expected one a file", path,
                                   in_quotes(found->name), in_quotes(v.name)));
    found = &v;
  }
  if (!found)
    throw InputError(
        fmt::format("{}: none of its variables ({}) is an array of structures with "
                    "NAME and SIGNAL, as MVIEW's are",
                    path, names));
  return *found;
}

std::vector<Trajectory> moving(const DataTree& array, const std::string& path) {
  std::vector<Trajectory> result;
  for (const DataTree& element : array.children) {
    const DataTree *name = element.find("NAME"), *rate = element.find("SRATE"),
                   *signal = element.find("SIGNAL");
    if (!name || !signal || signal->kind != Kind::numbers || signal->columns < 2) continue;
    if (name->kind != Kind::text || name->text.empty())
      throw InputError(path + ": a trajectory has no NAME");
    const double hertz = rate ? rate->scalar() : std::nan("");
    if (!(hertz > 0 && hertz <= highest_rate))
      throw InputError(fmt::format("{}: {} has no SRATE above 0", path, in_quotes(name->text)));
    for (const Trajectory& t : result)
      if (t.name == name->text)
        throw InputError(fmt::format("{}: {} stands twice", path, in_quotes(t.name)));
    result.push_back({name->text, hertz, signal});
  }
  if (result.empty())
    throw InputError(
        path +
        ": no trajectory has samples of x, y and z; is it a recording of sound, or cut short?");
  return result;
}

/// Sensors are sampled together. What has another rate is no sensor of them.
double usual_rate(const std::vector<Trajectory>& all) {
  std::map<double, int> counts;
  for (const Trajectory& t : all) ++counts[t.rate];
  return std::max_element(counts.begin(), counts.end(),
                          [](const auto& a, const auto& b) { return a.second < b.second; })
      ->first;
}

/// Two coordinates are x and z.
Vec3 position(const DataTree& signal, size_t sample) {
  const auto at = [&](size_t column) { return signal.numbers[column * signal.rows + sample]; };
  return signal.columns == 2 ? sensor_position(at(0), 0, at(1))
                             : sensor_position(at(0), at(1), at(2));
}

SensorTable table_of(const DataTree& array, const std::string& path) {
  std::vector<Trajectory> all = moving(array, path);
  SensorTable table;
  table.rate_hz = usual_rate(all), table.recording = array.name;
  size_t most = 0, least = size_t(-1);
  std::erase_if(all, [&](const Trajectory& t) {
    if (t.rate == table.rate_hz) return false;
    table.remarks.push_back(
        fmt::format("{} left out: it has {:g} samples a second, the others "
                    "{:g}",
                    t.name, t.rate, table.rate_hz));
    return true;
  });
  for (const Trajectory& t : all) {
    table.names.push_back(t.name);
    most = std::max(most, t.signal->rows), least = std::min(least, t.signal->rows);
  }
  if (most != least)
    table.remarks.push_back(
        fmt::format("trajectories have {} to {} samples; those that end early "
                    "are missing after that",
                    least, most));
  for (size_t s = 0; s < most; ++s) {
    auto& row = table.samples.emplace_back();
    for (const Trajectory& t : all)
      row.push_back(s < t.signal->rows ? position(*t.signal, s) : Vec3::Constant(std::nan("")));
  }
  label_samples(table, array);
  return table;
}

/// Matrices that may be a trace: points by 2 or 3, or the other way round.
std::vector<const DataTree*> traces_of(const DataTree& file) {
  std::vector<const DataTree*> traces;
  for (const DataTree& v : file.children) {
    const size_t few = std::min(v.rows, v.columns), many = std::max(v.rows, v.columns);
    if (v.kind == Kind::numbers && !v.numbers.empty() && (few == 2 || few == 3) && many > 3)
      traces.push_back(&v);
  }
  return traces;
}

RawContours read_trace(const DataTree& file, const std::string& path, const ReadOptions& o) {
  std::vector<std::string> names;
  for (const DataTree* v : traces_of(file)) names.push_back(v->name);
  if (names.empty())
    throw InputError(
        fmt::format("{}: no variable is a matrix of 2 or 3 columns; expected a trace "
                    "of the {}",
                    path, o.role));
  const DataTree& trace = *file.find(named_curve(names, o, path));
  const bool upright = trace.rows > trace.columns;
  const size_t points = upright ? trace.rows : trace.columns,
               axes = upright ? trace.columns : trace.rows;
  RawContours raw{{}, SensorTable{}.axes};
  raw.file.model_frame = false;
  ContourFrame& frame = raw.file.frames.emplace_back();
  frame.number = 1;
  for (size_t k = 0; k < points; ++k) {
    const auto at = [&](size_t axis) {
      return trace.numbers[upright ? axis * points + k : k * axes + axis];
    };
    const Vec3 p(at(0), axes == 2 ? 0 : at(1), at(axes - 1));
    if (p.allFinite()) frame.points.push_back({p, 0, o.role});
  }
  raw.file.remarks.push_back(
      fmt::format("{} is the {}: {} points", trace.name, o.role, frame.points.size()));
  return raw;
}

RawContours read(const std::string& path, const ReadOptions& o) {
  const DataTree file = read_mat_file(path);
  // A bite plane may be sensors that are known by their names.
  const bool trace = o.role == "palate" || (o.role == "bite plane" && !traces_of(file).empty());
  if (trace && o.sensors.empty()) return read_trace(file, path, o);
  return sensor_frames(path, table_of(trajectories_of(file, path), path), o);
}

}  // namespace

ContourFormat mview_format() {
  ReadOptions sensors;
  sensors.sensors = {{"TT", "tip+10mm"}};
  return {
      .traits = {.name = "mview", .content = Content::sensors},
      .about = "MVIEW's MATLAB files (Haskins), v5 and v7.3",
      .known_by_bytes =
          [](const FileStart& start) { return start.ending == ".mat" || start.bytes == "MATL"; },
      .known_by_line = {},
      .read = read,
      .example = {.name = "take.mat", .text = mview_example(), .options = sensors}};
}

}  // namespace genio
