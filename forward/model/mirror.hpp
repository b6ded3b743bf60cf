#pragma once
// A tongue that is its own mirror image, solved on its right half.

#include <memory>
#include <optional>

#include "forward/model/model.hpp"

namespace genio {

/// The right half of a model, and how its nodes stand for the model's.
struct Mirror {
  Model half;
  std::vector<int> node;     ///< of the half, for each node of the whole
  std::vector<double> side;  ///< -1 for nodes left of the midsagittal plane, else 1
  std::vector<int> right;    ///< node of the whole, for each node of the half

  /// Columns of nodal vectors of the half (positions, or their derivatives) on the whole tongue.
  Matrix whole(const Matrix& of_half) const;
  /// The right half of symmetric nodal vectors.
  Matrix right_half(const Matrix& of_whole) const;
};

/// The mirror of a model whose mesh, muscles and contact surfaces are symmetric, and whose forces
/// at a symmetric shape are, as are their derivatives for the given parameters: checked by their
/// values, so that an effect of one side is found out. Empty otherwise, or where the model does not
/// say what it was built from.
std::unique_ptr<const Mirror> mirror_of(const Model& model,
                                        const std::vector<std::string>& parameters = {});

}  // namespace genio
