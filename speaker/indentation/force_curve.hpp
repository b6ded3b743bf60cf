#pragma once
// Force against depth, with its derivatives by what the block is made of.

#include <array>
#include <span>
#include <string>
#include <vector>

#include "forward/statics/equilibrium.hpp"
#include "speaker/indentation/indentation_model.hpp"

namespace genio {

/// The whole block's answer at one depth.
struct ForcePoint {
  double depth;                                    ///< prescribed [m]
  double force;                                    ///< [N]
  double slope;                                    ///< its derivative by the depth [N/m]
  std::array<double, block_constants> derivative;  ///< by each constant [N/Pa]
  double centre;                                   ///< depth of the top on the axis [m]
  Positions x;                                     ///< shape of the quarter [m]
};

struct ForceCurve {
  std::string message;  ///< the reason where it ends early; empty when it is whole
  std::vector<ForcePoint> points;
  int newton_iterations = 0, factorizations = 0;

  explicit operator bool() const { return message.empty(); }
};

/// Equilibria at rising depths [m], each from the one before along its tangent or, where `near` has
/// the same depth, from the shape there. Derivatives are exact: those of the equilibrium.
ForceCurve solve_force_curve(const IndentationModel& model, const BlockTissue& tissue,
                             std::span<const double> depths, Workspace& ws,
                             const ForceCurve* near = nullptr);

}  // namespace genio
