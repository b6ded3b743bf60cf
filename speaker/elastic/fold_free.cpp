#include "speaker/elastic/fold_free.hpp"

#include <Eigen/Dense>
#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>

#include "forward/algebra/cholesky.hpp"
#include "speaker/elastic/corner_shape.hpp"

namespace genio {
namespace {

using Vec24 = Eigen::Matrix<double, 24, 1>;
using Mat24 = Eigen::Matrix<double, 24, 24>;

struct ElementTerms {
  double energy = 0;
  Vec24 gradient = Vec24::Zero();
  Mat24 stiffness = Mat24::Zero();
};

/// Corners smaller than this part of their element are no shape to keep.
constexpr double poor_corner = 0.25;
constexpr double no_energy = std::numeric_limits<double>::infinity();

/// Adds the derivative of the edges' matrix by the nodes, seen through `by_edges`, to `v`.
void onto_nodes(int corner, const Mat3& by_edges, Vec24& v) {
  for (int k = 0; k < 3; ++k) {
    const EdgeEnds ends = corner_edge(corner, k);
    v.segment<3>(3 * ends.high) += by_edges.col(k);
    v.segment<3>(3 * ends.low) -= by_edges.col(k);
  }
}

/// The cofactor matrix, which is the determinant's derivative.
Mat3 cofactor_of(const Mat3& m) {
  Mat3 c;
  c.col(0) = m.col(1).cross(m.col(2));
  c.col(1) = m.col(2).cross(m.col(0));
  c.col(2) = m.col(0).cross(m.col(1));
  return c;
}

/// One element's terms; the energy alone where `derivatives` is false.
ElementTerms element_terms(const FoldFreeProblem& p, const Positions& x, size_t e,
                           bool derivatives) {
  ElementTerms t;
  const auto position = [&](int a) -> Vec3 { return node_position(x, p.mesh->elements[e][a]); };
  const double weight = p.stiffness * p.volumes[e] / 8;
  std::array<Mat3, 8> edges;
  std::array<double, 8> size;
  double mean = 0;
  for (int c = 0; c < 8; ++c) {
    edges[c] = corner_edges(position, c);
    size[c] = edges[c].determinant();
    mean += size[c] / 8;
    const Mat3& shape = p.shapes[e][c];
    const Mat3 f = edges[c] * shape;
    if (!derivatives) {
      t.energy += weight * corner_energy(f);
      continue;
    }
    const CornerEnergy corner = corner_energy_with_derivatives(f);
    t.energy += weight * corner.value;
    onto_nodes(c, weight * corner.gradient * shape.transpose(), t.gradient);
    // The corner and its three neighbours alone are coupled.
    std::array<int, 4> nodes = {c, 0, 0, 0};
    std::array<double, 4> sign = {0, 0, 0, 0};
    for (int k = 0; k < 3; ++k) {
      const EdgeEnds ends = corner_edge(c, k);
      const bool here_low = ends.low == c;
      nodes[k + 1] = here_low ? ends.high : ends.low;
      sign[k + 1] = here_low ? 1 : -1;
    }
    Eigen::Matrix<double, 12, 12> block = Eigen::Matrix<double, 12, 12>::Zero();
    for (size_t d = 0; d < 9; ++d) {
      if (!(corner.stiffness[d] > 0)) continue;
      const Mat3 by_edges = corner.direction[d] * shape.transpose();
      Eigen::Matrix<double, 12, 1> v = Eigen::Matrix<double, 12, 1>::Zero();
      for (int k = 0; k < 3; ++k) {
        v.segment<3>(3 * (k + 1)) = sign[k + 1] * by_edges.col(k);
        v.head<3>() -= sign[k + 1] * by_edges.col(k);
      }
      block += weight * corner.stiffness[d] * v * v.transpose();
    }
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j)
        t.stiffness.block<3, 3>(3 * nodes[i], 3 * nodes[j]) += block.block<3, 3>(3 * i, 3 * j);
  }
  if (!(p.quality > 0)) return t;
  const double per_corner = p.quality * p.volumes[e] / 8;
  Vec24 by_mean = Vec24::Zero();
  if (derivatives)
    for (int c = 0; c < 8; ++c) onto_nodes(c, cofactor_of(edges[c]) / 8, by_mean);
  for (int c = 0; c < 8; ++c) {
    const double part = size[c] / mean;
    if (!(part > 0)) return {no_energy, t.gradient, t.stiffness};
    const double excess = p.wanted / part - 1;
    if (excess <= 0) continue;
    t.energy += per_corner * excess * excess;
    if (!derivatives) continue;
    Vec24 by_part = -part * by_mean;
    onto_nodes(c, cofactor_of(edges[c]), by_part);
    by_part *= -p.wanted / (part * part) / mean;  // now of the excess
    t.gradient += 2 * per_corner * excess * by_part;
    t.stiffness += 2 * per_corner * by_part * by_part.transpose();
  }
  return t;
}

Vec3 way_of(const Pull& pull, const Positions& x) {
  Vec3 d = -pull.goal;
  for (size_t i = 0; i < 4; ++i)
    if (pull.nodes[i] >= 0) d += pull.weights[i] * node_position(x, pull.nodes[i]);
  return d;
}

double assemble(const FoldFreeProblem& p, const Positions& x, Vector& gradient, Stiffness& k) {
  gradient = Vector::Zero(x.size());
  k.set_zero();
  double energy = 0;
  for (size_t e = 0; e < p.mesh->elements.size(); ++e) {
    const ElementTerms t = element_terms(p, x, e, true);
    energy += t.energy;
    const auto& nodes = p.mesh->elements[e];
    for (int i = 0; i < 8; ++i) {
      gradient.segment<3>(3 * nodes[i]) += t.gradient.segment<3>(3 * i);
      for (int j = 0; j <= i; ++j) k.add(nodes[i], nodes[j], t.stiffness.block<3, 3>(3 * i, 3 * j));
    }
  }
  for (const Pull& pull : p.pulls) {
    const Vec3 d = way_of(pull, x), force = pull.metric * d;
    energy += 0.5 * d.dot(force);
    for (size_t i = 0; i < 4; ++i) {
      if (pull.nodes[i] < 0) continue;
      gradient.segment<3>(3 * pull.nodes[i]) += pull.weights[i] * force;
      for (size_t j = 0; j <= i; ++j)
        if (pull.nodes[j] >= 0)
          k.add(pull.nodes[i], pull.nodes[j], pull.weights[i] * pull.weights[j] * pull.metric);
    }
  }
  return energy;
}

}  // namespace

CornerShapes corner_shapes(const HexMesh& mesh) {
  CornerShapes shapes(mesh.elements.size());
  for (size_t e = 0; e < mesh.elements.size(); ++e) {
    std::array<Mat3, 8> edges;
    Mat3 middle = Mat3::Zero();
    for (size_t c = 0; c < 8; ++c) {
      edges[c] = corner_edges(
          [&](int a) -> Vec3 { return mesh.nodes[size_t(mesh.elements[e][size_t(a)])]; }, int(c));
      middle += edges[c] / 8;
      if (!(edges[c].determinant() > 0))
        throw std::invalid_argument("corner_shapes: an element is folded");
    }
    const double least = poor_corner * middle.determinant();
    for (size_t c = 0; c < 8; ++c)
      shapes[e][c] = (edges[c].determinant() > least ? edges[c] : middle).inverse();
  }
  return shapes;
}

double fold_free_energy(const FoldFreeProblem& p, const Positions& x) {
  double energy = 0;
  for (size_t e = 0; e < p.mesh->elements.size() && energy < no_energy; ++e)
    energy += element_terms(p, x, e, false).energy;
  for (const Pull& pull : p.pulls) {
    const Vec3 d = way_of(pull, x);
    energy += 0.5 * d.dot(pull.metric * d);
  }
  return energy;
}

Vector fold_free_gradient(const FoldFreeProblem& p, const Positions& x) {
  Vector gradient;
  Stiffness k(std::make_shared<BlockPattern>(*p.mesh, std::span<const std::pair<int, int>>{}));
  assemble(p, x, gradient, k);
  return gradient;
}

FoldFreeResult minimise_fold_free(const FoldFreeProblem& p, const Positions& start,
                                  const FoldFreeOptions& options) {
  const auto pattern =
      std::make_shared<const BlockPattern>(*p.mesh, std::span<const std::pair<int, int>>{});
  const DofMap dofs(p.supports);
  Stiffness k(pattern);
  ReducedStiffness reduced(*pattern, dofs);
  Cholesky factor(reduced);
  FoldFreeResult result{start, fold_free_energy(p, start), 0};
  if (!std::isfinite(result.energy))
    throw std::invalid_argument("minimise_fold_free: an element is folded at the start");
  while (result.steps < options.most_steps) {
    ++result.steps;
    Vector gradient;
    result.energy = assemble(p, result.x, gradient, k);
    reduced.assign(k);
    const Vector slope = dofs.reduce(gradient);
    double shift = 1e-10 * reduced.trace() / double(std::max(1, dofs.unknowns()));
    while (!factor.factorize(reduced, shift)) shift = 100 * shift + 1e-30;
    const Vector step = factor.solve(Vector(-slope));
    const Vector way = dofs.expand(step);
    double part = 1, energy = no_energy;
    const double downhill = slope.dot(step);
    Positions x;
    for (; part > 1e-6; part *= 0.5) {
      x = result.x + part * way;
      energy = fold_free_energy(p, x);
      if (energy <= result.energy + 1e-4 * part * downhill) break;
    }
    if (!(part > 1e-6)) break;
    result.x = x, result.energy = energy;
    if (part * way.cwiseAbs().maxCoeff() < options.small_step) break;
  }
  return result;
}

}  // namespace genio
