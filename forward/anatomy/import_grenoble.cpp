#include "forward/anatomy/import_grenoble.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <sstream>

namespace genio {
namespace {

namespace fs = std::filesystem;

/// Lines of a text file without their end, with the line numbers errors need.
class Lines {
 public:
  explicit Lines(const fs::path& path) : path_(path.string()), in_(path) {
    if (!in_) throw InputError(path_ + ": no such file");
  }
  bool next(std::string& line) {
    if (!std::getline(in_, line)) return false;
    ++number_;
    if (!line.empty() && line.back() == '\r') line.pop_back();
    return true;
  }
  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(fmt::format("{}:{}: {}", path_, number_, what));
  }

 private:
  std::string path_;
  std::ifstream in_;
  int number_ = 0;
};

/// Node numbers listed in a file, 0-based there and here.
std::vector<int> read_list(const fs::path& path, size_t nodes) {
  Lines lines(path);
  std::vector<int> list;
  for (std::string line; lines.next(line);) {
    std::istringstream in(line);
    for (std::string token; in >> token;) {
      char* end = nullptr;
      const long n = std::strtol(token.c_str(), &end, 10);
      if (*end || n < 0 || n >= long(nodes))
        lines.fail(fmt::format("'{}'; expected a node number from 0 to {}", token, nodes - 1));
      list.push_back(int(n));
    }
  }
  return list;
}

HexMesh read_mesh(const fs::path& folder) {
  HexMesh mesh;
  std::string line;
  Lines nodes(folder / "tongue.node");
  while (nodes.next(line)) {
    if (line.find_first_not_of(" \t") == std::string::npos) continue;
    std::istringstream in(line);
    size_t id = 0;
    Vec3 x;
    if (!(in >> id >> x[0] >> x[1] >> x[2]) || id != mesh.nodes.size() + 1)
      nodes.fail("expected 'id x y z' with ids in order from 1");
    mesh.nodes.push_back(x);
  }
  Lines elements(folder / "tongue.elem");
  while (elements.next(line)) {
    if (line.find_first_not_of(" \t") == std::string::npos) continue;
    std::istringstream in(line);
    std::array<int, 8> e;
    for (int& n : e)
      if (!(in >> n) || n < 1 || n > int(mesh.nodes.size()))
        elements.fail(fmt::format("expected 8 node numbers from 1 to {}", mesh.nodes.size()));
      else --n;
    mesh.elements.push_back(e);
  }
  return mesh;
}

/// Elements of each muscle, from the selections of CreateMuscles.mac.
std::map<std::string, std::vector<int>> read_muscle_elements(const fs::path& path, int elements) {
  Lines lines(path);
  std::map<std::string, std::vector<int>> result;
  std::vector<int> selection;
  const std::regex select(
      R"(^\s*ESEL\s*,\s*([SA])\s*,\s*ELEM\s*,\s*,\s*(\d+)\s*(?:,\s*(\d+)\s*(?:,\s*(\d+)\s*)?)?)");
  const std::regex name(R"(^\s*CM\s*,\s*(\w+)\s*,\s*ELEM)");
  std::smatch m;
  for (std::string line; lines.next(line);) {
    if (std::regex_search(line, m, select)) {
      if (m[1] == "S") selection.clear();
      const int first = std::stoi(m[2]), last = m[3].matched ? std::stoi(m[3]) : first;
      const int step = m[4].matched ? std::stoi(m[4]) : 1;
      if (first < 1 || last > elements || step < 1)
        lines.fail(fmt::format("element numbers must lie in 1 to {}", elements));
      for (int e = first; e <= last; e += step) selection.push_back(e - 1);
    } else if (std::regex_search(line, m, name)) {
      std::sort(selection.begin(), selection.end());
      selection.erase(std::unique(selection.begin(), selection.end()), selection.end());
      result[m[1]] = selection;
    }
  }
  return result;
}

/// Muscle names in their order, from `muscleName(k) = 'NAME'`.
std::vector<std::string> read_muscle_names(const fs::path& path) {
  Lines lines(path);
  std::vector<std::string> names;
  const std::regex pattern(R"(^\s*muscleName\((\d+)\)\s*=\s*'(\w+)')");
  std::smatch m;
  for (std::string line; lines.next(line);)
    if (std::regex_search(line, m, pattern)) {
      if (std::stoul(m[1]) != names.size() + 1) lines.fail("muscle numbers must be in order");
      names.push_back(m[2]);
    }
  return names;
}

void read_fibres(const fs::path& path, size_t nodes, std::vector<Muscle>& muscles) {
  const std::map<int, Vec3> anchors = {{4037, Vec3(0.14984029, -0.035891287, 0.125)},
                                       {4042, Vec3(0.14984029, 0.035891287, 0.125)}};
  Lines lines(path);
  const std::regex pattern(R"(^\s*FIBER\((\d+),(\d+),(\d+)\)\s*=\s*(\d+))");
  std::smatch match;
  for (std::string line; lines.next(line);) {
    if (!std::regex_search(line, match, pattern)) continue;
    const size_t i = std::stoul(match[1]), f = std::stoul(match[2]), m = std::stoul(match[3]);
    const int n = std::stoi(match[4]);
    if (m < 1 || m > muscles.size()) lines.fail(fmt::format("muscle {} does not exist", m));
    auto& fibres = muscles[m - 1].fibres;
    if (f == fibres.size() + 1) fibres.emplace_back();
    if (f != fibres.size() || i != fibres.back().size() + 1)
      lines.fail("fibre points must be in order");
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

}  // namespace

ModelDescription import_grenoble(const std::string& folder) {
  const fs::path tongue = fs::path(folder) / "tongue",
                 surfaces = fs::path(folder) / "surfaces_icp_m";
  if (!fs::is_directory(tongue))
    throw InputError(fmt::format("{}: expected a folder with tongue/ and surfaces_icp_m/", folder));
  ModelDescription d;
  d.name = "Grenoble tongue";
  d.provenance =
      "Gerard et al. 2003/2006, Buchaillard, Perrier & Payan 2009, Stavness et al. 2011/2012";
  d.mesh = read_mesh(tongue);
  const size_t n = d.mesh.nodes.size();
  d.supports.assign(n, Support::free);
  for (int a : read_list(tongue / "jawAttachments.txt", n)) d.supports[a] = Support::fixed;
  for (int a : read_list(tongue / "hyoidAttachments.txt", n)) d.supports[a] = Support::horizontal;

  const auto elements =
      read_muscle_elements(tongue / "CreateMuscles.mac", int(d.mesh.elements.size()));
  const auto forces = read_max_forces(tongue / "MuscleMaxForce.txt");
  for (const auto& name : read_muscle_names(tongue / "CreateMuscles.mac")) {
    const std::string both = bilateral_name(name);
    if (!forces.contains(both))
      throw InputError(fmt::format("{}: muscle {} has no maximum force",
                                   (tongue / "MuscleMaxForce.txt").string(), both));
    if (!elements.contains(name))
      throw InputError(fmt::format("{}: muscle {} has no elements",
                                   (tongue / "CreateMuscles.mac").string(), name));
    Muscle m;
    m.name = name;
    m.max_force = forces.at(both) * (both == name ? 1.0 : 0.5);
    m.elements = elements.at(name);
    d.muscles.push_back(std::move(m));
  }
  read_fibres(tongue / "Fibers.mac", n, d.muscles);

  // The outline runs from the jaw insertion over tip and dorsum to the hyoid, then back along the
  // floor; the part up to the hyoid is the tongue's surface line.
  for (int a : read_list(tongue / "tongueContourNodes.txt", n)) {
    d.midsagittal.push_back(a);
    if (a == 847) break;
  }
  d.landmarks = {919, 869, 927};
  d.palate = read_surface((surfaces / "ICPPalate3.obj").string());
  d.jaw = read_surface((surfaces / "ICPJaw3.obj").string());
  d.hyoid = read_surface((surfaces / "ICPHyoid3.obj").string());
  d.effects["elasticity"] = {{"a10", 1037}, {"a20", 486}, {"kappa", 1037000}};
  d.effects["palate_contact"] = {{"stiffness", 2e8}, {"damping", 5}};
  d.effects["jaw_contact"] = {{"stiffness", 2e8}, {"damping", 5}};
  d.effects["viscosity"] = {{"alpha", 40}, {"beta", 0.03}};
  return d;
}

}  // namespace genio
