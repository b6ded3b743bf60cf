// Forces of indenters against the formulas of the linear theory.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "speaker/indentation/force_curve.hpp"

namespace genio {
namespace {

constexpr double a10 = 192, radius = 5e-3;

/// E / (1 - nu^2) of tissue with the shear modulus 2 a10.
double plane_modulus(double nu) { return 4 * a10 / (1 - nu); }

/// Force at a small depth; thickness and half width in radii.
double force_at(Indenter indenter, double thickness, double half_width, double nu, double depth,
                const BlockGrid& grid) {
  const IndentationExperiment e{.indenter = indenter,
                                .radius = radius,
                                .thickness = thickness * radius,
                                .half_width = half_width * radius,
                                .poisson_ratio = nu};
  const BlockTissue tissue{{a10, 0}, {}};
  const IndentationModel m(e, depth, tissue, grid);
  Workspace ws(m.model);
  const ForceCurve curve = solve_force_curve(m, tissue, std::vector{depth}, ws);
  EXPECT_TRUE(curve) << curve.message;
  return curve ? curve.points.back().force : 0;
}

TEST(Indentation, OfADeepBlockByAPunchIsBoussinesqs) {
  const double depth = 0.005 * radius, nu = 0.499;
  EXPECT_NEAR(force_at(Indenter::punch, 100, 100, nu, depth, {2, 0.08, 1.3}) /
                  (2 * radius * plane_modulus(nu) * depth),
              1, 0.03);
}

TEST(Indentation, OfADeepBlockByAPressureHasItsMeanDepth) {
  const double depth = 0.005 * radius, nu = 0.499;
  EXPECT_NEAR(force_at(Indenter::pressure, 100, 100, nu, depth, {3, 0.08, 1.3}) /
                  (3 * std::pow(std::numbers::pi, 2) / 16 * radius * plane_modulus(nu) * depth),
              1, 0.03);
}

TEST(Indentation, OfADeepBlockByASphereIsHertzs) {
  const double depth = 0.01 * radius, nu = 0.499;
  EXPECT_NEAR(force_at(Indenter::sphere, 10, 10, nu, depth, {3, 0.12, 1.35}) /
                  (4.0 / 3 * std::sqrt(radius) * std::pow(depth, 1.5) * plane_modulus(nu)),
              1, 0.03);
}

// Sides that are free make it a little softer than the layer of Hayes, which has none.
TEST(Indentation, OfABlockOfTenRadiiByAPunchIsThatOfALayer) {
  const double depth = 0.005 * radius, nu = 0.499;
  EXPECT_NEAR(force_at(Indenter::punch, 10, 10, nu, depth, {2, 0.08, 1.3}) /
                  (2 * radius * plane_modulus(nu) * depth * 1.126),
              1, 0.03);
}

struct LayerCase {
  double radius_over_thickness, factor;
};

class ThinLayers : public testing::TestWithParam<LayerCase> {};

// The factors solve Hayes' integral equation for a Poisson ratio of 0.49.
TEST_P(ThinLayers, StiffenAPunchAsHayesSays) {
  const auto [ratio, factor] = GetParam();
  const double depth = 0.005 * radius, nu = 0.49;
  EXPECT_NEAR(force_at(Indenter::punch, 1 / ratio, 12, nu, depth, {2, 0.08, 1.4}) /
                  (2 * radius * plane_modulus(nu) * depth * factor),
              1, 0.03);
}

INSTANTIATE_TEST_SUITE_P(Indentation, ThinLayers,
                         testing::Values(LayerCase{0.2, 1.274}, LayerCase{0.4, 1.664},
                                         LayerCase{1, 3.484}));

}  // namespace
}  // namespace genio
