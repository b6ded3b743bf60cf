// The smooth map of the plane meets its pairs, keeps affine maps, and knows its derivative.

#include "speaker/outline/thin_plate.hpp"

#include "tests/speaker/shapes.hpp"

namespace genio {
namespace {

std::vector<PlacePair> pairs_of(const std::function<Vec2(const Vec2&)>& map) {
  std::vector<PlacePair> pairs;
  for (int i = 0; i < 5; ++i)
    for (int k = 0; k < 4; ++k) {
      const Vec2 p(0.01 * i + 0.001 * k, 0.012 * k);
      pairs.push_back({p, map(p)});
    }
  return pairs;
}

Vec2 bent(const Vec2& p) {
  return {1.1 * p[0] + 0.05 * std::sin(50 * p[1]), p[1] - 0.002 * std::cos(90 * p[0])};
}

TEST(ThinPlate, MeetsItsPairs) {
  const ThinPlateMap map(pairs_of(bent));
  for (const PlacePair& p : pairs_of(bent)) EXPECT_LT((map(p.from) - p.to).norm(), 1e-10);
}

TEST(ThinPlate, IsAffineWhereThePairsAre) {
  const auto affine = [](const Vec2& p) {
    return Vec2(0.3 + 1.2 * p[0] - 0.1 * p[1], 0.2 * p[0] + 0.9 * p[1]);
  };
  const ThinPlateMap map(pairs_of(affine));
  const Vec2 far(0.3, -0.2);
  EXPECT_LT((map(far) - affine(far)).norm(), 1e-9);
  EXPECT_LT((affine_map(pairs_of(affine))(far) - affine(far)).norm(), 1e-6);
}

TEST(ThinPlate, DerivativeIsTheMapsSlope) {
  const ThinPlateMap map(pairs_of(bent));
  const Vec2 p(0.021, 0.017);
  for (int i = 0; i < 2; ++i) {
    Vec2 step = Vec2::Zero();
    step[i] = 1e-7;
    const Vec2 slope = (map(p + step) - map(p - step)) / 2e-7;
    EXPECT_LT((map.derivative(p).col(i) - slope).norm(), 1e-6);
  }
}

TEST(ThinPlate, MeetsPairsThatMayNotSlideAsSmoothOnesDo) {
  const double smoothing = 0.1;
  std::vector<SlidingPair> held, fully_held;
  for (const PlacePair& p : pairs_of(bent)) {
    held.push_back({p.from, p.to});
    fully_held.push_back({p.from, p.to, Vec2(0.6, 0.8), 1});
  }
  const ThinPlateMap smooth(pairs_of(bent), smoothing);
  const Vec2 p(0.021, 0.017);
  for (const auto& pairs : {held, fully_held})
    EXPECT_LT((ThinPlateMap(pairs, smoothing)(p) - smooth(p)).norm(), 1e-12);
}

TEST(ThinPlate, SlidingPairsLeaveAnAffineMapAsItIs) {
  // Each place is off along its own direction, as far as it likes.
  const auto affine = [](const Vec2& p) {
    return Vec2(0.3 + 1.2 * p[0] - 0.1 * p[1], 0.2 * p[0] + 0.9 * p[1]);
  };
  std::vector<SlidingPair> pairs;
  for (const PlacePair& p : pairs_of(affine)) {
    const double turn = 300 * p.from[0] + 77 * p.from[1];
    const Vec2 along(std::cos(turn), std::sin(turn));
    pairs.push_back({p.from, p.to + 4e-3 * std::sin(3 * turn) * along, along});
  }
  const Vec2 p(0.021, 0.017);
  EXPECT_LT((ThinPlateMap(pairs, 1e-3)(p) - affine(p)).norm(), 1e-9);
}

TEST(ThinPlate, SmoothingBendsLess) {
  const Vec2 p(0.02, 0.018);
  const double close = std::abs(ThinPlateMap(pairs_of(bent))(p)[0] - bent(p)[0]);
  const double stiff = std::abs(ThinPlateMap(pairs_of(bent), 10)(p)[0] - bent(p)[0]);
  EXPECT_LT(close, stiff);
}

}  // namespace
}  // namespace genio
