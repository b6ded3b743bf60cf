#include "bench/problems/calculix.hpp"

#include <fmt/format.h>
#include <fmt/os.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include "forward/anatomy/refine.hpp"
#include "forward/base/elapsed.hpp"

namespace genio::bench {
namespace {

namespace fs = std::filesystem;

/// The 12 edges in the order of CalculiX's 20-node element, after its 8 corners.
constexpr int edges[12][2] = {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6},
                              {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}};

void write_nodes(fmt::ostream& out, const CalculixProblem& p,
                 std::vector<std::vector<int>>& elements, std::vector<Support>& supports) {
  supports = p.supports;
  std::vector<Vec3> nodes = p.mesh.nodes;
  std::map<std::pair<int, int>, int> middle;
  for (const auto& e : p.mesh.elements) {
    auto& element = elements.emplace_back(e.begin(), e.end());
    if (p.element == CalculixElement::c3d8) continue;
    for (const auto& [i, j] : edges) {
      const int a = e[size_t(i)], b = e[size_t(j)];
      const auto [it, added] = middle.emplace(std::minmax(a, b), int(nodes.size()));
      if (added) {
        nodes.push_back(0.5 * (nodes[size_t(a)] + nodes[size_t(b)]));
        supports.push_back(support_between({supports[size_t(a)], supports[size_t(b)]}));
      }
      element.push_back(it->second);
    }
  }
  out.print("*NODE,NSET=ALL\n");
  for (size_t a = 0; a < nodes.size(); ++a)
    out.print("{},{:.12g},{:.12g},{:.12g}\n", a + 1, nodes[a][0], nodes[a][1], nodes[a][2]);
}

void write_supports(fmt::ostream& out, const std::vector<Support>& supports) {
  int body = -1;
  for (size_t a = 0; a < supports.size(); ++a) {
    if (supports[a] == Support::horizontal && body < 0) body = int(a);
    else if (supports[a] == Support::horizontal)
      for (int i = 1; i <= 2; ++i)
        out.print("*EQUATION\n2\n{},{},1.,{},{},-1.\n", a + 1, i, body + 1, i);
  }
  out.print("*BOUNDARY\n");
  for (size_t a = 0; a < supports.size(); ++a) {
    if (supports[a] == Support::fixed) out.print("{},1,3\n", a + 1);
    if (supports[a] == Support::horizontal) out.print("{},3,3\n", a + 1);
  }
}

void write_input(const std::string& path, const CalculixProblem& p) {
  auto out = fmt::output_file(path);
  std::vector<std::vector<int>> elements;
  std::vector<Support> supports;
  write_nodes(out, p, elements, supports);
  out.print("*ELEMENT,TYPE={},ELSET=TISSUE\n",
            p.element == CalculixElement::c3d8 ? "C3D8" : "C3D20R");
  for (size_t e = 0; e < elements.size(); ++e) {
    out.print("{}", e + 1);
    for (size_t i = 0; i < elements[e].size(); ++i)
      out.print("{}{}", i == 15 ? ",\n" : ",", elements[e][i] + 1);  // 16 numbers a line
    out.print("\n");
  }
  out.print("*ELSET,ELSET=LOADED\n");
  for (int e : p.loaded) out.print("{}\n", e + 1);
  // U = sum C_i0 (I - 3)^i + (J - 1)^2 / D1: D1 = 2 / kappa.
  out.print("*MATERIAL,NAME=YEOH\n*HYPERELASTIC,YEOH\n{:.9g},{:.9g},0.,{:.9g},0.,0.\n",
            p.constants.a10, p.constants.a20, 2 / p.constants.kappa);
  out.print("*DENSITY\n{}\n", p.density);
  if (p.alpha > 0 || p.beta > 0) out.print("*DAMPING,ALPHA={},BETA={}\n", p.alpha, p.beta);
  out.print("*SOLID SECTION,ELSET=TISSUE,MATERIAL=YEOH\n");
  write_supports(out, supports);
  out.print("*STEP,NLGEOM,INC=1000\n");
  if (p.duration > 0) out.print("*DYNAMIC,DIRECT\n{},{}\n", p.step, p.duration);
  else out.print("*STATIC\n0.1,1.\n");
  const double size = p.force.norm();
  const Vec3 d = p.force / size;
  if (size > 0)
    out.print("*DLOAD\nLOADED,GRAV,{:.9g},{:.9g},{:.9g},{:.9g}\n", size / p.density, d[0], d[1],
              d[2]);
  if (!p.nodal.empty()) out.print("*CLOAD\n");
  for (size_t a = 0; a < p.nodal.size(); ++a)
    for (int i = 0; i < 3; ++i)
      if (p.nodal[a][i] != 0) out.print("{},{},{:.9g}\n", a + 1, i + 1, p.nodal[a][i]);
  out.print("*NODE PRINT,NSET=ALL,FREQUENCY=1000\nU\n*END STEP\n");
}

}  // namespace

std::optional<CalculixResult> run_calculix(const CalculixProblem& p) {
  if (std::system("command -v ccx >/dev/null 2>&1") != 0) return {};
  std::string name = (fs::temp_directory_path() / "genio-ccx-XXXXXX").string();
  if (!mkdtemp(name.data())) return {};
  const fs::path folder = name;
  write_input((folder / "job.inp").string(), p);
  const double before = children_seconds();
  const std::string command = fmt::format(
      "cd '{}' && OMP_NUM_THREADS=1 CCX_NPROC_EQUATION_SOLVER=1 OPENBLAS_NUM_THREADS=1 ccx -i job "
      ">job.log 2>&1",
      name);
  const bool ended = std::system(command.c_str()) == 0;
  CalculixResult result{rest_positions(p.mesh), children_seconds() - before, false};
  std::ifstream in(folder / "job.dat");
  double reached = 0;
  for (std::string line; std::getline(in, line);) {
    if (const auto at = line.find("time"); at != std::string::npos) {
      reached = std::strtod(line.c_str() + at + 4, nullptr);
      result.x = rest_positions(p.mesh);  // the last table counts
      continue;
    }
    std::istringstream row(line);
    int node;
    Vec3 u;
    if (row >> node >> u[0] >> u[1] >> u[2] && node <= int(p.mesh.nodes.size()))
      result.x.segment<3>(3 * (node - 1)) += u;
  }
  const double whole = p.duration > 0 ? p.duration : 1;
  result.complete = ended && reached > whole * (1 - 1e-6);
  fs::remove_all(folder);
  return result;
}

}  // namespace genio::bench
