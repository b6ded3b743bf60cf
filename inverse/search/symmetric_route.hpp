#pragma once
// Symmetric problems on half a tongue: the same answers at less than half the cost.

#include "forward/model/mirror.hpp"
#include "inverse/shape/infer.hpp"

namespace genio {

/// True where left and right are joined, nothing was measured off the midsagittal plane, and the
/// prior speaks of no single side.
bool fits_half_tongue(const Target& target, const Prior& prior, const InferOptions& options);

/// The problem's parts for the half's model, beside half_prior().
Target half_target(const Mirror& mirror, const Target& target);
InferOptions half_options(const Mirror& mirror, const InferOptions& options);

/// Forces of both sides from those of one; other unknowns stay.
void double_forces(std::vector<Estimate>& unknowns);
void double_forces(std::vector<JointForce>& joint);

/// The half's answer as one of the whole tongue.
Answer whole_answer(const Mirror& mirror, Answer answer);

}  // namespace genio
