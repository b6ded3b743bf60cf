#include "speaker/indentation/simulated_data.hpp"

#include <random>
#include <stdexcept>

#include "speaker/indentation/curve_between.hpp"
#include "speaker/indentation/force_curve.hpp"

namespace genio {

ForceData scattered(const ForceData& exact, double scatter, unsigned seed) {
  ForceData d = exact;
  d.sd = scatter * exact.force;
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  for (Eigen::Index i = 0; i < d.force.size(); ++i) d.force[i] += (*d.sd)[i] * normal(random);
  return d;
}

ForceData simulated_data(const IndentationExperiment& e, const BlockTissue& tissue, double depth,
                         int rows, double scatter, unsigned seed, const BlockGrid& grid) {
  ForceData d;
  d.depth = Vector::LinSpaced(rows, depth / rows, depth);
  const CurveBetween between(d.depth, e.indenter);
  const IndentationModel model(e, depth, tissue, grid);
  Workspace ws(model.model);
  const ForceCurve curve = solve_force_curve(model, tissue, between.nodes, ws);
  if (!curve) throw std::runtime_error("simulated indentation: " + curve.message);
  Vector at_nodes(Eigen::Index(curve.points.size()));
  for (size_t k = 0; k < curve.points.size(); ++k)
    at_nodes[Eigen::Index(k)] = curve.points[k].force;
  d.force = between.weights * at_nodes;
  return scatter > 0 ? scattered(d, scatter, seed) : d;
}

}  // namespace genio
