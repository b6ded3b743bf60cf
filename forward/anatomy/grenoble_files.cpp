#include "forward/anatomy/grenoble_files.hpp"

#include <fmt/format.h>

#include <charconv>
#include <fstream>
#include <regex>
#include <sstream>

#include "forward/base/input_file.hpp"

namespace genio::grenoble {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t largest_file = std::uintmax_t(64) << 20;
constexpr size_t longest_line = 1000;  // std::regex goes a call deeper with each character
constexpr int most_selections = 200;

/// Lines of a text file without their end, with the line numbers errors need.
class Lines {
 public:
  explicit Lines(const fs::path& path) : path_(path.string()) {
    check_input(path_, largest_file);
    in_.open(path_);
    if (!in_) throw InputError(path_ + ": cannot be read");
  }
  bool next(std::string& line) {
    if (!std::getline(in_, line)) return false;
    ++number_;
    if (!line.empty() && line.back() == '\r') line.pop_back();
    if (line.size() > longest_line)
      fail(fmt::format("the line is longer than {} characters", longest_line));
    return true;
  }
  /// The next line with more than blanks.
  bool next_filled(std::string& line) {
    while (next(line))
      if (line.find_first_not_of(" \t") != std::string::npos) return true;
    return false;
  }
  int whole_number(const std::string& digits) const {
    int n = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), n);
    if (error != std::errc() || end != digits.data() + digits.size())
      fail(fmt::format("'{}' is no number that a mesh can need", digits));
    return n;
  }
  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(fmt::format("{}:{}: {}", path_, number_, what));
  }

 private:
  std::string path_;
  std::ifstream in_;
  int number_ = 0;
};

void add_nodes(const fs::path& path, HexMesh& mesh) {
  Lines lines(path);
  for (std::string line; lines.next_filled(line);) {
    std::istringstream in(line);
    size_t id = 0;
    Vec3 x;
    if (!(in >> id >> x[0] >> x[1] >> x[2]) || id != mesh.nodes.size() + 1)
      lines.fail("expected 'id x y z' with ids in order from 1");
    mesh.nodes.push_back(x);
  }
  if (mesh.nodes.empty()) throw InputError(path.string() + ": has no node");
}

}  // namespace

std::vector<int> read_list(const fs::path& path, size_t nodes) {
  Lines lines(path);
  std::vector<int> list;
  for (std::string line; lines.next(line);) {
    std::istringstream in(line);
    for (std::string token; in >> token;) {
      int n = -1;
      const auto [end, error] = std::from_chars(token.data(), token.data() + token.size(), n);
      if (error != std::errc() || end != token.data() + token.size() || n < 0 || size_t(n) >= nodes)
        lines.fail(
            fmt::format("'{}'; expected a node number from 0 to {}", token, double(nodes) - 1));
      list.push_back(n);
    }
  }
  return list;
}

HexMesh read_mesh(const fs::path& nodes, const fs::path& elements) {
  HexMesh mesh;
  add_nodes(nodes, mesh);
  Lines lines(elements);
  for (std::string line; lines.next_filled(line);) {
    std::istringstream in(line);
    std::array<int, 8> e;
    for (int& n : e)
      if (!(in >> n) || n < 1 || n > int(mesh.nodes.size()))
        lines.fail(fmt::format("expected 8 node numbers from 1 to {}", mesh.nodes.size()));
      else --n;
    mesh.elements.push_back(e);
  }
  return mesh;
}

std::map<std::string, std::vector<int>> read_muscle_elements(const fs::path& path, int elements) {
  Lines lines(path);
  std::map<std::string, std::vector<int>> result;
  std::vector<bool> selected(size_t(elements), false);
  static const std::regex select(
      R"(^\s*ESEL\s*,\s*([SA])\s*,\s*ELEM\s*,\s*,\s*(\d+)\s*(?:,\s*(\d+)\s*(?:,\s*(\d+)\s*)?)?)");
  static const std::regex name(R"(^\s*CM\s*,\s*(\w+)\s*,\s*ELEM)");
  std::smatch m;
  for (std::string line; lines.next(line);) {
    if (std::regex_search(line, m, select)) {
      if (m[1] == "S") selected.assign(selected.size(), false);
      const int first = lines.whole_number(m[2]);
      const int last = m[3].matched ? lines.whole_number(m[3]) : first;
      const int step = m[4].matched ? lines.whole_number(m[4]) : 1;
      if (first < 1 || last > elements || step < 1)
        lines.fail(
            fmt::format("element numbers must lie in 1 to {}, and their step above 0", elements));
      // As 64 bits: the step may be any int.
      for (int64_t e = first; e <= last; e += step) selected[size_t(e - 1)] = true;
    } else if (std::regex_search(line, m, name)) {
      std::vector<int>& list = result[m[1]];
      if (result.size() > most_selections)
        lines.fail(fmt::format("more than {} selections are named", most_selections));
      list.clear();
      for (int e = 0; e < elements; ++e)
        if (selected[size_t(e)]) list.push_back(e);
    }
  }
  return result;
}

std::vector<std::string> read_muscle_names(const fs::path& path) {
  Lines lines(path);
  std::vector<std::string> names;
  static const std::regex pattern(R"(^\s*muscleName\((\d+)\)\s*=\s*'(\w+)')");
  std::smatch m;
  for (std::string line; lines.next(line);)
    if (std::regex_search(line, m, pattern)) {
      if (lines.whole_number(m[1]) != int(names.size()) + 1)
        lines.fail("muscle numbers must be in order");
      names.push_back(m[2]);
    }
  return names;
}

void read_fibres(const fs::path& path, size_t nodes, std::vector<Muscle>& muscles) {
  const std::map<int, Vec3> anchors = {{4037, Vec3(0.14984029, -0.035891287, 0.125)},
                                       {4042, Vec3(0.14984029, 0.035891287, 0.125)}};
  Lines lines(path);
  static const std::regex pattern(R"(^\s*FIBER\((\d+),(\d+),(\d+)\)\s*=\s*(\d+))");
  std::smatch match;
  for (std::string line; lines.next(line);) {
    if (!std::regex_search(line, match, pattern)) continue;
    const int i = lines.whole_number(match[1]), f = lines.whole_number(match[2]),
              m = lines.whole_number(match[3]), n = lines.whole_number(match[4]);
    if (m < 1 || m > int(muscles.size())) lines.fail(fmt::format("muscle {} does not exist", m));
    auto& fibres = muscles[size_t(m) - 1].fibres;
    if (f == int(fibres.size()) + 1) fibres.emplace_back();
    if (f < 1 || f != int(fibres.size()) || i != int(fibres.back().size()) + 1)
      lines.fail(fmt::format(
          "point {} of fibre {}: fibres and their points must be in order, from 1", i, f));
    if (const auto anchor = anchors.find(n); anchor != anchors.end())
      fibres.back().push_back({-1, anchor->second});
    else if (n >= 1 && n <= int(nodes)) fibres.back().push_back({n - 1, Vec3::Zero()});
    else lines.fail(fmt::format("node {} is neither in the mesh nor a styloid anchor", n));
  }
}

std::map<std::string, double> read_max_forces(const fs::path& path) {
  Lines lines(path);
  std::map<std::string, double> forces;
  for (std::string line; lines.next(line);) {
    std::istringstream in(line);
    std::string name;
    double force = 0;
    if (!(in >> name)) continue;
    if (!(in >> force) || !(force > 0)) lines.fail("expected 'NAME FORCE' with a force above 0");
    forces[name] = force;
  }
  return forces;
}

}  // namespace genio::grenoble
