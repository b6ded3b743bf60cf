#pragma once
// The other route to the same optimum: positions and commands together as unknowns.

#include "inverse/search/multi_start.hpp"

namespace genio {

/// The misfit over nodal positions and commands, equilibrium F(x, z) = 0 as constraints, by Ipopt
/// with sparse exact derivatives: no equilibrium is solved on the way. From shapes some millimetres
/// off, straight steps of nearly incompressible tissue swell and Ipopt creeps; so the first way
/// goes by the reduced problem, until it promises a fall of less than 1. `options` count as in
/// infer(). The optimum then goes through the reduced objective for its posterior: both routes
/// answer in the same words. infer() is ten to twenty times faster and the default; this one checks
/// it by other equations.
Answer infer_full_space(const Model& model, const Target& target, const Prior& prior, Workspace& ws,
                        const InferOptions& options = {});

}  // namespace genio
