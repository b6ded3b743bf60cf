#pragma once
#include <gtest/gtest.h>

#include "forward/model/build_model.hpp"
#include "inverse/shape/infer.hpp"
#include "tests/forward/small_model.hpp"

namespace genio::test {

/// The generic tongue, and contours of it under known forces.
class PulledTongue : public testing::Test {
 protected:
  /// Commands [N] to the noiseless midsagittal line; fails the test where there is no equilibrium.
  Target pulled(const std::vector<std::pair<const char*, double>>& forces, int count = 40,
                double sigma = 5e-4) {
    Parameters p = default_parameters(m);
    for (const auto& [name, f] : forces) set_command(m, name, f, p);
    const auto e = solve_equilibrium(m, p, m.rest, ws);
    EXPECT_TRUE(e) << e.message;
    return curve_target(m, e.x, count, sigma);
  }
  const Model m = read_model(generic_model());
  Workspace ws{m};
};

}  // namespace genio::test
