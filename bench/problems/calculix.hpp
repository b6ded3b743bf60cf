#pragma once
// CalculiX as an independent solver of the same tissue problems, where `ccx` is installed.

#include <optional>
#include <string>

#include "forward/effects/tissue/elasticity.hpp"
#include "forward/model/model.hpp"

namespace genio::bench {

enum class CalculixElement { c3d8, c3d20r };  ///< fully integrated linear; quadratic, reduced

/// A problem for CalculiX: the model's mesh and supports with its own law and a body force.
struct CalculixProblem {
  const HexMesh& mesh;
  const std::vector<Support>& supports;
  TissueConstants constants;
  std::vector<int> loaded;  ///< elements that the body force acts on
  Vec3 force;               ///< per volume [N/m^3]
  CalculixElement element = CalculixElement::c3d8;
  std::vector<Vec3> nodal = {};  ///< dead forces on the mesh's nodes [N]; empty: none
  // Dynamics where duration > 0:
  double duration = 0, step = 0, density = 1040, alpha = 0, beta = 0;
};

struct CalculixResult {
  Positions x;    ///< of the mesh's nodes [m]
  double cpu_s;   ///< of the ccx process
  bool complete;  ///< reached the full load or time
};

/// Runs ccx on one thread in a temporary folder. Nothing where ccx is not installed.
std::optional<CalculixResult> run_calculix(const CalculixProblem& problem);

}  // namespace genio::bench
