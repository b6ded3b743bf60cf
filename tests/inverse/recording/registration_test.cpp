#include "inverse/recording/registration.hpp"

#include <gtest/gtest.h>

#include "forward/model/build_model.hpp"
#include "tests/forward/small_model.hpp"

namespace genio {
namespace {

/// A trace cut from the model's own palate, moved away, must come back.
TEST(Registration, BringsAMovedPalateBack) {
  const Model m = read_model(test::generic_model());
  const auto palate = midsagittal_cut(*m.palate).front();
  const Similarity away{1.03, 0.2, Vec2(-0.08, -0.1)};
  std::vector<Vec2> trace;
  for (size_t i = 0; i < palate.size(); ++i)
    if (palate[i][0] > 0.055 && palate[i][0] < 0.12 && palate[i][1] > 0.1)
      trace.push_back(away(palate[i]));
  std::vector<std::vector<Vec2>> contours(1);
  for (const Vec2& q : TongueLine(m).sample(m.rest, 30)) contours[0].push_back(away(q));
  const auto r = register_by_palate(m, reach_of(m), trace, contours);
  EXPECT_LT(r.palate_rms, 1e-3);
  for (size_t i = 0; i < contours[0].size(); ++i)
    EXPECT_LT((r.transform(contours[0][i]) - TongueLine(m).sample(m.rest, 30)[i]).norm(), 3e-3);
}

TEST(Registration, NeedsPalateAndTrace) {
  const Model m = read_model(test::generic_model());
  EXPECT_THROW(register_by_palate(m, reach_of(m), {Vec2(0, 0)}, {}), InputError);
  ModelParts parts = m.parts();
  parts.palate.reset();
  EXPECT_THROW(register_by_palate(Model(parts), reach_of(m), std::vector<Vec2>(10, Vec2(0, 0)), {}),
               InputError);
}

}  // namespace
}  // namespace genio
