// What a file doubts pulls less, and what it does not doubt is as if it had said nothing.

#include "inverse/recording/base/confidence.hpp"

#include "inverse/recording/frame_target.hpp"
#include "inverse/target/comparison.hpp"
#include "tests/forward/small_model.hpp"
#include "tests/inverse/recording/formats/formats_fixture.hpp"

namespace genio {
namespace {

class Confidences : public Formats {
 protected:
  static std::string table(const std::vector<double>& likelihoods) {
    std::string text = "x,y,frame,likelihood\n";
    for (size_t k = 0; k < likelihoods.size(); ++k)
      text += fmt::format("{},{},1,{}\n", 200 + 40 * k, 300 - 10 * k, likelihoods[k]);
    return text;
  }
  static ReadOptions pixels() {
    ReadOptions o;
    o.mm_per_px = 0.3;
    return o;
  }
};

TEST_F(Confidences, VarianceIsOverTheLikelihood) {
  EXPECT_EQ(widening_by_likelihood(1), 1);
  EXPECT_DOUBLE_EQ(widening_by_likelihood(0.64), 1.25);
  EXPECT_EQ(widening_by_confidence(90, 80), 1);
  EXPECT_DOUBLE_EQ(widening_by_confidence(64, 81), 9.0 / 8);
  EXPECT_EQ(widening_by_residual(12), 1);
  EXPECT_EQ(widening_by_residual(-30), 2);
  EXPECT_EQ(widening_by_residual(std::nan("")), 1);
}

TEST_F(Confidences, ReadersGiveEachPointItsOwnAndSayHowMany) {
  const auto f = read_contours(write("c.csv", table({1, 0.64, 1, 0.81, 0.5})), pixels());
  const auto& points = f.frames.front().points;
  ASSERT_EQ(points.size(), 4u);
  EXPECT_DOUBLE_EQ(points[1].widening, 1.25);
  EXPECT_EQ(points[2].widening, 1);
  EXPECT_TRUE(says(f,
                   "2 of 4 points count less, by what the file says of them: their noise is up "
                   "to 1.25 times the others'"));
  EXPECT_FALSE(says(read_contours(write("s.csv", table({1, 1, 1})), pixels()), "count less"));
}

TEST_F(Confidences, ResidualsOfSensorsWidenTheirNoise) {
  std::string text = "Ch1_X\tCh1_Y\tCh1_Z\tCh1_phi\tCh1_theta\tCh1_RMS\tCh1_Extra\n";
  for (int k = 0; k < 20; ++k)
    text += fmt::format("{}\t1\t-3\t0\t0\t{}\t0\n", 10 + 0.1 * k, k == 7 ? 24 : 6);
  ReadOptions o;
  o.sensors = {{"1", "tip"}};
  const auto raw = read_raw(write("s.txt", text), o);
  EXPECT_EQ(raw.file.frames[6].points[0].widening, 1);
  EXPECT_DOUBLE_EQ(raw.file.frames[7].points[0].widening, 1.6);
  EXPECT_TRUE(says(raw.file, "1 of 20 points count less"));
}

TEST_F(Confidences, KnotsBelowTheUsualConfidenceCountLess) {
  std::string text =
      "Prompt\tNumber of points of spline \"Tongue\"\tX mm values of spline \"Tongue\"\t"
      "Y mm values of spline \"Tongue\"\tConfidence values of spline \"Tongue\"\nword\t5";
  for (int k = 0; k < 5; ++k) text += fmt::format("\t{}", -10 * k);
  for (int k = 0; k < 5; ++k) text += fmt::format("\t{}", 50 + k);
  text += "\t81\t81\t90\t64\t81\n";
  const auto f = read_raw(write("a.txt", text), {}).file;
  const auto& points = f.frames.front().points;
  ASSERT_EQ(points.size(), 5u);
  EXPECT_EQ(points[0].widening, 1);
  EXPECT_EQ(points[2].widening, 1);
  EXPECT_DOUBLE_EQ(points[3].widening, 9.0 / 8);
}

TEST_F(Confidences, TheTargetsNoiseIsWidenedUnlessThePointHasItsOwn) {
  const Model model = read_model(test::generic_model());
  ContourFrame frame;
  for (int k = 0; k < 3; ++k) {
    ContourPoint& p = frame.points.emplace_back();
    p.position = place_at_rest(model, k == 2 ? "dorsum" : "tip"), p.kind = "curve";
    p.position[0] += 1e-3 * k;
  }
  frame.points[1].widening = 2;
  frame.points[2].widening = 2, frame.points[2].sigma = 0.7e-3;
  const Target target = make_target(model, frame, 0.3e-3);
  EXPECT_EQ(target.curve[0].sigma, 0.3e-3);  // to the last bit
  EXPECT_EQ(target.curve[1].sigma, 0.6e-3);
  EXPECT_EQ(target.curve[2].sigma, 0.7e-3);
}

TEST_F(Confidences, NoiseIsTheDevicesAndGoesWithTheScale) {
  const Model model = read_model(test::generic_model());
  ContourFrame frame;
  for (int k = 0; k < 2; ++k) {
    ContourPoint& p = frame.points.emplace_back();
    p.position = place_at_rest(model, "dorsum") / 0.8, p.kind = "curve";
  }
  frame.points[1].sigma = 0.7e-3;
  const Target target = make_target(model, registered(model, frame, {.scale = 0.8}), 0.5e-3);
  ASSERT_EQ(target.curve.size(), 2u);
  EXPECT_DOUBLE_EQ(target.curve[0].sigma, 0.4e-3);
  EXPECT_DOUBLE_EQ(target.curve[1].sigma, 0.56e-3);
}

TEST_F(Confidences, AWidenedPointPullsLess) {
  const Model model = read_model(test::generic_model());
  ContourFrame frame;
  for (const double x : {0.0, 1e-3}) {
    ContourPoint& p = frame.points.emplace_back();
    p.position = place_at_rest(model, "dorsum") + Vec3(x, 0, 2e-3), p.kind = "curve";
  }
  const auto residual = [&](double widening) {
    frame.points[1].widening = widening;
    return Comparison(model, make_target(model, frame, 0.3e-3))(model.rest);
  };
  const auto sure = residual(1), unsure = residual(2);
  EXPECT_EQ(sure.values[0], unsure.values[0]);
  EXPECT_NEAR(unsure.values[1], 0.5 * sure.values[1], 1e-12);
}

}  // namespace
}  // namespace genio
