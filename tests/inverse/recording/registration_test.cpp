#include "inverse/recording/registration/registration.hpp"

#include <gtest/gtest.h>

#include "forward/model/build_model.hpp"
#include "forward/statics/equilibrium.hpp"
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

/// The tongue's line where each of some muscles pulls with a part of its maximum.
std::vector<std::vector<Vec2>> pulled_lines(const Model& m,
                                            const std::vector<const char*>& muscles) {
  Workspace ws(m);
  std::vector<std::vector<Vec2>> lines;
  for (const char* muscle : muscles) {
    double most = 0;
    for (int k : command_parameters(m, muscle)) most += m.parameters[size_t(k)].info.upper;
    Parameters p = default_parameters(m);
    set_command(m, muscle, 0.25 * most, p);
    auto line = TongueLine(m).sample(solve_equilibrium(m, p, m.rest, ws).x, 40);
    lines.emplace_back(line.begin() + 8, line.end());
  }
  return lines;
}

/// Postures far from rest must not pull the recording away: what bends is the tongue.
TEST(Registration, PosturesFarFromRestLeaveTheHeadWhereItWas) {
  const Model m = read_model(test::generic_model());
  const TongueReach reach = reach_of(m);
  const auto palate = midsagittal_cut(*m.palate).front();
  const auto lines = pulled_lines(m, {"GGP", "HG", "STY"});
  for (const Similarity& away :
       {Similarity{0.91, 0.09, Vec2(-0.012, 0.036)}, Similarity{1.08, -0.25, Vec2(0.04, 0.01)},
        Similarity{0.97, 0.29, Vec2(0.02, -0.03)}}) {
    std::vector<Vec2> trace;
    for (size_t k = palate.size() / 6; k < 2 * palate.size() / 3; ++k)
      trace.push_back(away(palate[k]));
    std::vector<std::vector<Vec2>> contours = lines;
    for (auto& contour : contours)
      for (Vec2& q : contour) q = away(q);
    const Registration r = register_by_palate(m, reach, trace, contours);
    EXPECT_LT(r.cost, 15);
    EXPECT_LT(std::abs(r.transform.angle + away.angle), 2.5 * r.tilt_sd);
    Vec2 off = Vec2::Zero();
    for (size_t k = 0; k < trace.size(); ++k)
      off += (r.transform(trace[k]) - palate[k + palate.size() / 6]) / double(trace.size());
    EXPECT_LT(std::abs(off[0]), 3 * r.shift_sd[0]);
    EXPECT_LT(std::abs(off[1]), 3 * r.shift_sd[1]);
  }
}

/// A recording that is a twentieth larger: of a speaker like the model, or of the model's own.
TEST(Registration, AModelOfTheSpeakersOwnKeepsItsSize) {
  ModelDescription d = read_description(test::generic_model());
  const auto scale_for = [&](double scale_sd) {
    d.scale_sd = scale_sd;
    const Model m = build_model(d, "model");
    const auto palate = midsagittal_cut(*m.palate).front();
    std::vector<Vec2> trace;
    for (size_t k = palate.size() / 6; k < 2 * palate.size() / 3; ++k)
      trace.push_back(1.05 * palate[k]);
    std::vector<std::vector<Vec2>> contours = pulled_lines(m, {"GGP", "HG"});
    for (auto& contour : contours)
      for (Vec2& q : contour) q *= 1.05;
    return register_by_palate(m, reach_of(m), trace, contours).transform.scale;
  };
  EXPECT_NEAR(scale_for(0.06), 1 / 1.05, 0.015);
  EXPECT_NEAR(scale_for(0.003), 1, 0.01);
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
