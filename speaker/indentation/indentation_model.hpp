#pragma once
// A block under an indenter as a model to be solved.

#include <memory>

#include "forward/model/model.hpp"
#include "speaker/indentation/block.hpp"

namespace genio {

class IndenterPotential;

/// What the block is made of.
struct BlockTissue {
  YeohConstants muscle, mucosa;  ///< the mucosa's count where there is one
};

/// Constants of the tissue, in the order of derivatives by them.
enum BlockConstant : int { by_a10, by_a20, by_mucosa_a10, by_mucosa_a20, block_constants };

/// A quarter of the block and its indenter. Constant; solve_force_curve() solves it.
struct IndentationModel {
  /// For depths up to `greatest_depth` [m]. The indenter's penalty is chosen for tissue about as
  /// stiff as `about`: of that, the tissue misses the depth by less than 0.1 %. Throws InputError
  /// where no such experiment can be (check()).
  IndentationModel(const IndentationExperiment& experiment, double greatest_depth,
                   const BlockTissue& about, const BlockGrid& grid = {});

  IndentationExperiment experiment;
  double contact;  ///< radius of what touches, as the mesh was made for it [m]
  std::shared_ptr<const IndenterPotential> indenter;
  Model model;
  int centre;  ///< node of the top on the axis
  int depth;   ///< index of the indenter's depth among the model's parameters
  int first_constant;

  /// The model's parameters for a tissue and a depth [m].
  Parameters parameters(const BlockTissue& tissue, double depth_m) const;

 private:
  struct Made;
  explicit IndentationModel(const Made& made);
};

}  // namespace genio
