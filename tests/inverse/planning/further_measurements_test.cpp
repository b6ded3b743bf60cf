#include "inverse/planning/further_measurements.hpp"

#include <cmath>

#include "inverse/target/facets.hpp"
#include "tests/inverse/pulled_tongue.hpp"

namespace genio {
namespace {

class FurtherMeasurements : public test::PulledTongue {
 protected:
  FurtherMeasurement of(const std::string& text, const Target& measured = {}) {
    return further_measurement(m, measured, m.rest, text);
  }
  std::string error(const std::string& text, const Target& measured = {}) {
    try {
      of(text, measured);
    } catch (const InputError& e) {
      return e.what();
    }
    return "none";
  }
};

TEST_F(FurtherMeasurements, PointsLieOnTheShape) {
  const Target slice = of("slice=dorsum").points, line = of("contour").points;
  EXPECT_GT(slice.surface.size(), 10u);
  EXPECT_GT(line.curve.size(), 40u);
  EXPECT_NEAR(Comparison(m, slice)(m.rest).max, 0, 1e-9);
  EXPECT_NEAR(Comparison(m, line)(m.rest).max, 0, 1e-6);
  EXPECT_NEAR(Comparison(m, of("sensors=tip+10mm,dorsum").points)(m.rest).max, 0, 1e-12);
}

TEST_F(FurtherMeasurements, ASliceRunsToBothSidesAlike) {
  const Target slice = of("slice=tip+25mm").points;
  double most = 0, least = 0;
  for (const SurfacePoint& p : slice.surface)
    most = std::max(most, p.position[1]), least = std::min(least, p.position[1]);
  EXPECT_GT(most, 8e-3);
  EXPECT_NEAR(most, -least, 1e-9);
}

TEST_F(FurtherMeasurements, WhatWasMeasuredIsNotMeasuredAgain) {
  const Target all = curve_target(m, m.rest, 80, 5e-4);
  EXPECT_NE(error("contour", all).find("measured already"), std::string::npos);
  for (const std::string& text : usual_measurements(m, all, m.rest, {"GGP"}))
    EXPECT_FALSE(text.starts_with("contour")) << text;
  Target front = all;
  front.curve.resize(40);
  EXPECT_LT(of("contour", front).points.curve.size(), of("contour").points.curve.size());
}

TEST_F(FurtherMeasurements, NoiseIsInMillimetresOrInParts) {
  EXPECT_DOUBLE_EQ(of("slice=dorsum@0.3mm").points.surface[0].sigma, 3e-4);
  EXPECT_DOUBLE_EQ(of("emg=GGP@0.2").emg_sd.at("GGP"), 0.2);
  EXPECT_DOUBLE_EQ(of("parameter=a.b@2").parameter_sd.at("a.b"), 2);
}

TEST_F(FurtherMeasurements, WhatIsNoneIsNamed) {
  EXPECT_NE(error("slise=dorsum").find("did you mean slice"), std::string::npos);
  EXPECT_NE(error("slice").find("as in slice=tip+20mm"), std::string::npos);
  EXPECT_NE(error("contour=back").find("expected underside"), std::string::npos);
  EXPECT_NE(error("sensors=tip@0.3").find("@0.5mm"), std::string::npos);
  EXPECT_NE(error("sensors=tip,,dorsum").find("a place is missing"), std::string::npos);
  EXPECT_NE(error("parameter=a.b").find("@0.5"), std::string::npos);
  EXPECT_NE(error("slice=tip+900mm").find("900"), std::string::npos);
}

}  // namespace
}  // namespace genio
