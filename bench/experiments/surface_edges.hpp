#pragma once
#include "forward/model/model.hpp"

namespace genio::bench {

/// How much sharper than at rest the surface's edges became [deg].
struct EdgeSharpness {
  double largest, p99;
};

/// Of the edges between neighbouring faces of the tongue's own surface, in the shape `x`.
EdgeSharpness sharpness(const Model& model, const Positions& x);

}  // namespace genio::bench
