#include "inverse/recording/sensor_place.hpp"

#include <gtest/gtest.h>

#include "forward/model/build_model.hpp"
#include "tests/forward/small_model.hpp"

namespace genio {
namespace {

Vec3 at_rest(const Model& m, const std::string& place) {
  Vec3 sum = Vec3::Zero();
  for (const auto& [node, weight] : sensor_place(m, place))
    sum += weight * m.mesh.nodes[size_t(node)];
  return sum;
}

/// One frame of sensors where the model has `places`, called `kinds`, at a scale.
ContourFile glued(const Model& m, const std::vector<std::string>& kinds,
                  const std::vector<std::string>& places, double scale = 1) {
  ContourFile file;
  ContourFrame frame;
  for (size_t k = 0; k < kinds.size(); ++k)
    frame.points.push_back({scale * at_rest(m, places[k]), 0, kinds[k]});
  file.frames.push_back(frame);
  return file;
}

TEST(SensorPlace, ALengthBehindTheTipIsThatFarAlongTheLine) {
  const Model m = read_model(test::generic_model());
  EXPECT_EQ(sensor_place(m, "tip"), (std::vector<std::pair<int, double>>{{m.landmarks.tip, 1.0}}));
  double sum = 0;
  for (const auto& [node, weight] : sensor_place(m, "tip+13mm")) sum += weight;
  EXPECT_NEAR(sum, 1, 1e-12);
  const double chord = (at_rest(m, "tip+13mm") - at_rest(m, "tip+10mm")).norm();
  EXPECT_GT(chord, 2.5e-3);
  EXPECT_LE(chord, 3e-3 + 1e-9);
  EXPECT_NEAR(behind_tip(m, "tip+13mm"), 13e-3, 1e-12);
  EXPECT_NEAR(behind_tip(m, "dorsum-4mm"), behind_tip(m, "dorsum") - 4e-3, 1e-12);
}

TEST(SensorPlace, WhatIsNoPlaceIsNamed) {
  const Model m = read_model(test::generic_model());
  for (const char* place : {"tip+13", "tip+", "tip+13cm", "tpi", "tip+900mm", "node:-1", ""})
    EXPECT_THROW(sensor_place(m, place), InputError) << place;
}

TEST(SensorPlace, PlacesThatFitTheDistancesAreNoContradictionAtAnyScaleOfASpeaker) {
  const Model m = read_model(test::generic_model());
  const std::vector<std::string> usual = {"tip+10mm", "tip+25mm", "tip+40mm"};
  for (const double scale : {0.75, 1.0, 1.3})
    EXPECT_EQ(place_contradiction(m, glued(m, usual, usual, scale)), "");
}

TEST(SensorPlace, SensorsCloseTogetherAreNotTipBladeAndDorsum) {
  const Model m = read_model(test::generic_model());
  const auto file = glued(m, {"tip", "blade", "dorsum"}, {"tip+8mm", "tip+17mm", "tip+26mm"});
  const std::string said = place_contradiction(m, file);
  EXPECT_NE(said.find("mm in the model; give the places by their length behind the tip"),
            std::string::npos)
      << said;
  const auto places = places_by_distance(m, file);
  EXPECT_NEAR(places.at("tip"), 10e-3, 1e-12);
  EXPECT_NEAR(places.at("blade"), 19e-3, 1e-3);
  EXPECT_NEAR(places.at("dorsum"), 28e-3, 1.5e-3);
}

TEST(SensorPlace, SensorsSaidToBeTwiceAsFarApartAreUnlikely) {
  const Model m = read_model(test::generic_model());
  const std::vector<std::string> said = {"tip", "tip+20mm", "tip+40mm"};
  const auto file = glued(m, said, {"tip+5mm", "tip+15mm", "tip+25mm"});
  const std::string doubt = place_contradiction(m, file, any_scale, usual_stretch);
  EXPECT_NE(doubt.find("By their distances these fit"), std::string::npos) << doubt;
  const std::vector<std::string> places = {"tip+5mm", "tip+25mm", "tip+45mm"};
  EXPECT_EQ(place_contradiction(m, glued(m, places, places, 0.9), any_scale, usual_stretch), "");
}

TEST(SensorPlace, SensorsInTheOtherOrderAreAContradiction) {
  const Model m = read_model(test::generic_model());
  const auto file = glued(m, {"tip", "tip+18mm", "tip+9mm"}, {"tip", "tip+9mm", "tip+18mm"});
  const std::string said = place_contradiction(m, file);
  EXPECT_NE(said.find("the other way round"), std::string::npos) << said;
}

TEST(SensorPlace, TwoSensorsAtOnePlaceLieTogether) {
  const Model m = read_model(test::generic_model());
  EXPECT_NE(place_contradiction(m, glued(m, {"tip", "tip"}, {"tip", "tip+17mm"})).find("apart"),
            std::string::npos);
  EXPECT_EQ(place_contradiction(m, glued(m, {"tip", "tip"}, {"tip", "tip+2mm"})), "");
}

TEST(SensorPlace, ADistanceThatOtherUnitsWouldExplainAsksForThem) {
  const Model m = read_model(test::generic_model());
  const std::vector<std::string> places = {"tip+10mm", "tip+25mm", "tip+40mm"};
  auto file = glued(m, places, places, 0.1);  // centimetres, read as millimetres
  file.units = "mm";
  EXPECT_NE(place_contradiction(m, file).find("are its units cm?"), std::string::npos)
      << place_contradiction(m, file);
  file = glued(m, places, places, 0.4);  // nothing explains that
  file.units = "mm";
  EXPECT_NE(place_contradiction(m, file), "");
  EXPECT_EQ(place_contradiction(m, file).find("are its units"), std::string::npos);
}

}  // namespace
}  // namespace genio
