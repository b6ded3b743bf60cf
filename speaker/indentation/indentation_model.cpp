#include "speaker/indentation/indentation_model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "speaker/indentation/indenter_potential.hpp"
#include "speaker/indentation/layered_tissue.hpp"

namespace genio {
namespace {

constexpr double much_stiffer = 5000;  // indenter over tissue

double contact_radius(const IndentationExperiment& e, double greatest_depth) {
  if (e.indenter != Indenter::sphere) return e.radius;
  return std::min(std::sqrt(e.radius * greatest_depth), 0.9 * e.radius);  // Hertz
}

/// Of the indenter's penalty, beside a half space.
double penalty(const IndentationExperiment& e, double contact, const BlockTissue& about) {
  const double modulus = 8 * std::max(about.muscle.a10, e.mucosa > 0 ? about.mucosa.a10 : 0);
  return e.indenter == Indenter::pressure ? much_stiffer * 2 * contact * modulus / 4
                                          : much_stiffer * modulus / contact;
}

Model assembled(const IndentationExperiment& e, const IndentedBlock& block,
                const BlockTissue& about, std::shared_ptr<const IndenterPotential> indenter) {
  ModelParts m;
  m.name = "indented block";
  m.mesh = block.mesh;
  m.supports = block.supports;
  const YeohConstants mucosa = e.mucosa > 0 ? about.mucosa : about.muscle;
  m.effects = {{.potential = std::make_shared<LayeredTissue>(block, about.muscle, mucosa,
                                                             bulk_over_a10(e.poisson_ratio))},
               {.potential = std::move(indenter)}};
  return Model(std::move(m));
}

}  // namespace

struct IndentationModel::Made {
  IndentationExperiment experiment;
  BlockTissue about;
  double contact;
  IndentedBlock block;
  std::shared_ptr<const IndenterPotential> indenter;

  Made(const IndentationExperiment& e, double greatest_depth, const BlockTissue& tissue,
       const BlockGrid& grid)
      : experiment(e), about(tissue) {
    check(e);
    if (!(greatest_depth > 0 && greatest_depth < 0.8 * e.thickness))
      throw InputError(
          fmt::format("depth: {:g} mm; expected more than 0 and less than 0.8 of the thickness of "
                      "the block, {:g} mm",
                      1e3 * greatest_depth, 1e3 * e.thickness));
    contact = contact_radius(e, greatest_depth);
    block = indented_block(e, contact, grid);
    indenter = indenter_potential(block, e, penalty(e, contact, tissue));
  }
};

IndentationModel::IndentationModel(const IndentationExperiment& e, double greatest_depth,
                                   const BlockTissue& about, const BlockGrid& grid)
    : IndentationModel(Made(e, greatest_depth, about, grid)) {}

IndentationModel::IndentationModel(const Made& made)
    : experiment(made.experiment),
      contact(made.contact),
      indenter(made.indenter),
      model(assembled(made.experiment, made.block, made.about, made.indenter)),
      centre(made.block.centre),
      depth(parameter_index(model, "indenter.depth")),
      first_constant(parameter_index(model, "tissue.a10")) {}

Parameters IndentationModel::parameters(const BlockTissue& t, double depth_m) const {
  Parameters p = default_parameters(model);
  p.segment(first_constant, block_constants) << t.muscle.a10, t.muscle.a20, t.mucosa.a10,
      t.mucosa.a20;
  p[depth] = depth_m;
  return p;
}

}  // namespace genio
