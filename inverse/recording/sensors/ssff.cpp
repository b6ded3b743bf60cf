#include "inverse/recording/sensors/ssff.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>
#include <map>
#include <sstream>

#include "inverse/recording/sensors/sensor_frames.hpp"

namespace genio {
namespace {

struct Column {
  std::string name;
  size_t count, bytes;  // values, and bytes of each
  bool floating;
};

struct Header {
  std::vector<Column> columns;
  double rate = 0;
  size_t size = 0, record = 0;  // bytes
};

Header read_header(const std::string& bytes, const std::string& path) {
  const std::string rule = "-----------------\n";
  const auto end = bytes.find(rule);
  if (end == std::string::npos) throw InputError(path + ": its SSFF header does not end");
  Header h;
  h.size = end + rule.size();
  std::istringstream lines(bytes.substr(0, end));
  int number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    std::istringstream words(line);
    std::string word;
    words >> word;
    if (word == "Record_Freq") words >> h.rate;
    if (word == "Machine" && words >> word && word != "IBM-PC")
      throw InputError(fmt::format("{}:{}: Machine {}; only IBM-PC (little endian) is read", path,
                                   number, word));
    if (word != "Column") continue;
    Column c;
    std::string type;
    double count = 0;
    words >> c.name >> type >> count;
    c.floating = type == "FLOAT" || type == "DOUBLE";
    c.bytes = type == "DOUBLE" ? 8 : type == "FLOAT" ? 4 : type == "LONG" ? 4 : 2;
    if ((!c.floating && type != "SHORT" && type != "LONG") || !(count >= 1 && count <= 1e5))
      throw InputError(
          fmt::format("{}:{}: expected Column NAME FLOAT|DOUBLE|SHORT|LONG COUNT", path, number));
    c.count = size_t(count);
    h.record += c.count * c.bytes;
    h.columns.push_back(c);
  }
  if (h.columns.empty()) throw InputError(path + ": its SSFF header has no Column");
  if (!(h.rate > 0)) throw InputError(path + ": its SSFF header has no Record_Freq above 0");
  return h;
}

double number(const char* at, const Column& c) {
  const auto as = [&]<class T>(T v) { return std::memcpy(&v, at, sizeof v), double(v); };
  return c.bytes == 8   ? as(double())
         : c.floating   ? as(float())
         : c.bytes == 4 ? as(int())
                        : as(short());
}

/// "tt_posy" -> ("tt", 1): a scalar track of one coordinate.
std::pair<std::string, int> coordinate(const std::string& name) {
  if (name.size() < 2) return {name, -1};
  const int axis = std::string("xyz").find(char(std::tolower(name.back()))) == std::string::npos
                       ? -1
                       : std::tolower(name.back()) - 'x';
  std::string stem = name.substr(0, name.size() - 1);
  for (const char* tail : {"_pos", "pos", "_", "-", "."})
    if (stem.size() > std::strlen(tail) && stem.ends_with(tail))
      stem.resize(stem.size() - std::strlen(tail));
  return {stem, axis};
}

/// The sensors of a file, and where in a record their coordinates lie.
struct Sensors {
  struct Source {
    size_t column, offset;
  };
  std::vector<Source> sources;
  std::vector<std::string> names;
  std::vector<std::array<int, 3>> parts;  ///< of each sensor: the source of x, y, z; -1: none
};

Sensors sensors_of(const Header& h) {
  Sensors s;
  std::map<std::string, size_t> by_stem;
  size_t offset = 0;
  for (size_t k = 0; k < h.columns.size(); ++k) {
    const Column& c = h.columns[k];
    const int first = int(s.sources.size());
    if (c.count == 1) {
      const auto [stem, axis] = coordinate(c.name);
      if (axis >= 0) {
        const auto [it, fresh] = by_stem.try_emplace(stem, s.parts.size());
        if (fresh) s.names.push_back(stem), s.parts.push_back({-1, -1, -1});
        s.parts[it->second][size_t(axis)] = first;
        s.sources.push_back({k, offset});
      }
    } else {
      s.names.push_back(c.name);
      s.parts.push_back(c.count == 2 ? std::array{first, -1, first + 1}
                                     : std::array{first, first + 1, first + 2});
      for (size_t i = 0; i < std::min<size_t>(3, c.count); ++i)
        s.sources.push_back({k, offset + i * c.bytes});
    }
    offset += c.count * c.bytes;
  }
  // Two scalar tracks of a sensor are its horizontal and its vertical one, whatever they are
  // called.
  for (auto& p : s.parts)
    if (p[2] < 0) std::swap(p[1], p[2]);
  return s;
}

}  // namespace

RawContours read_ssff(const std::string& path, const ReadOptions& o) {
  std::ifstream in(path, std::ios::binary);
  if (!in) throw InputError(path + ": no such file");
  const std::string bytes{std::istreambuf_iterator<char>(in), {}};
  const Header h = read_header(bytes, path);
  if ((bytes.size() - h.size) % h.record != 0)
    throw InputError(fmt::format("{}: {} bytes of records; expected a multiple of {}", path,
                                 bytes.size() - h.size, h.record));
  const Sensors sensors = sensors_of(h);
  SensorTable table{sensors.names, {}, h.rate};
  for (size_t at = h.size; at < bytes.size(); at += h.record) {
    auto& row = table.samples.emplace_back();
    for (const auto& p : sensors.parts) {
      Vec3 v = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
      for (int i = 0; i < 3; ++i)
        if (p[size_t(i)] >= 0) {
          const Sensors::Source& s = sensors.sources[size_t(p[size_t(i)])];
          v[i] = number(bytes.data() + at + s.offset, h.columns[s.column]);
        }
      if (std::isnan(v[1])) v[1] = 0;
      row.push_back(v);
    }
  }
  if (table.samples.empty()) throw InputError(path + ": has no record");
  return sensor_frames(path, table, o);
}

}  // namespace genio
