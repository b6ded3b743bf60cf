// Points of the head that ultrasound shows tell where the head was; those that cannot be are left
// out, or are a fault.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "bench/experiments/recordings/synthetic_session.hpp"
#include "forward/model/build_model.hpp"
#include "inverse/recording/registration/head_places.hpp"
#include "inverse/recording/session/session.hpp"
#include "tests/forward/small_model.hpp"

namespace genio {
namespace {

using enum HeadPoint;

/// Ultrasound of the model itself, without a palate, with points of the head beside it.
class HeadMarksOfASession : public testing::Test {
 protected:
  const Model model = read_model(test::generic_model());

  static Vec3 numbers(const bench::SyntheticSession& s, const Vec2& q) {
    const Vec2 at = s.target_to_device(q);
    return {s.target_axes.back_grows ? at[0] : -at[0], std::nan(""), at[1]};
  }
  SessionFile target(const bench::SyntheticSession& s,
                     const std::map<HeadPoint, Vec2>& head) const {
    SessionFile t{"t", {}, {"mm", "right", "up"}};
    t.file.model_frame = false, t.file.units = "mm";
    for (const auto& line : s.frames) {
      ContourFrame& frame = t.file.frames.emplace_back();
      for (const Vec2& q : line)
        frame.points.push_back({.position = numbers(s, q), .kind = "curve"});
    }
    for (const auto& [point, q] : head) {
      const Vec3 p = 1e3 * numbers(s, q);
      t.file.head_points[point] = {Vec2(p[0], p[2])};
    }
    return t;
  }
  AlignedRecording aligned(const SessionFile& t, bool named = true) const {
    SessionMarks marks;
    marks.points = head_points_of(t, {}, named, {});
    return align(model, t, {}, {}, marks);
  }
  std::map<HeadPoint, Vec2> places() const {
    std::map<HeadPoint, Vec2> all;
    for (const HeadPoint point : {hyoid, short_tendon, mandible})
      all[point] = *place_in(model, point);
    return all;
  }
  bench::SyntheticSession session(unsigned seed) const {
    std::mt19937 random(seed);
    return draw_session(model, bench::Device::aaa, random);
  }
  static bool faulted(const AlignedRecording& a, const std::string& text) {
    return std::any_of(a.judgement.faults.begin(), a.judgement.faults.end(),
                       [&](const auto& fault) { return fault.find(text) != std::string::npos; });
  }
  static bool remarks(const AlignedRecording& a, const std::string& text) {
    return std::any_of(a.file.remarks.begin(), a.file.remarks.end(),
                       [&](const auto& line) { return line.find(text) != std::string::npos; });
  }
};

TEST_F(HeadMarksOfASession, ThePlacesOfTheModelAreThoseOfAnatomy) {
  const Vec2 tendon = *place_in(model, short_tendon), edge = *place_in(model, mandible);
  const Vec2 bone = *place_in(model, hyoid);
  EXPECT_NEAR(tendon[1] - edge[1], 8e-3, 4e-3);  // over 41 speakers 6.8 mm, sd 2.4
  EXPECT_NEAR(tendon[0] - edge[0], 2.6e-3, 3e-3);
  EXPECT_NEAR(bone[0] - edge[0], 40e-3, 12e-3);
}

TEST_F(HeadMarksOfASession, TellTiltAndPlaceBetterThanContoursAlone) {
  constexpr int draws = 5;
  double tilt[2] = {}, shift[2] = {};
  for (unsigned k = 0; k < draws; ++k) {
    const auto s = session(100 + k);
    const SessionFile t = target(s, places());
    Vec2 middle = Vec2::Zero();
    for (const Vec2& q : s.frames[0]) middle += q / double(s.frames[0].size());
    for (const int with : {0, 1}) {
      const Similarity found = aligned(t, with == 1).registration.transform;
      const double turn = found.angle + s.target_to_device.angle;
      tilt[with] += turn * turn;
      shift[with] += (found(s.target_to_device(middle)) - middle).squaredNorm();
    }
  }
  EXPECT_LT(tilt[1], 0.5 * tilt[0]);
  EXPECT_LT(shift[1], 0.5 * shift[0]);
}

TEST_F(HeadMarksOfASession, AreSaidToBeUsedAndHowFarOffTheyAre) {
  const auto a = aligned(target(session(3), places()));
  EXPECT_TRUE(remarks(a, "registered by points of the head"));
  EXPECT_EQ(a.head_points.size(), 3u);
  for (const auto& [point, off] : a.head_points) EXPECT_LT(off, sd_of(point)) << name_of(point);
  EXPECT_TRUE(a.judgement.faults.empty());
}

TEST_F(HeadMarksOfASession, OneThatIsFarOffIsLeftOutWithARemark) {
  auto head = places();
  head[hyoid] += Vec2(0.09, 0.02);
  const auto a = aligned(target(session(3), head));
  EXPECT_TRUE(a.judgement.faults.empty()) << testing::PrintToString(a.judgement.faults);
  EXPECT_TRUE(remarks(a, "left out as it lies far from the model's"));
  EXPECT_EQ(a.head_points.size(), 2u);
  head = places();
  const auto without =
      aligned(target(session(3), {{short_tendon, head[short_tendon]}, {mandible, head[mandible]}}));
  EXPECT_NEAR(a.registration.transform.angle, without.registration.transform.angle, 1e-9);
}

TEST_F(HeadMarksOfASession, ASingleOneThatContoursCannotFollowIsLeftOut) {
  const auto a = aligned(target(session(3), {{hyoid, Vec2(0.3, -0.2)}}));
  EXPECT_TRUE(a.judgement.faults.empty()) << testing::PrintToString(a.judgement.faults);
  EXPECT_TRUE(remarks(a, "left out")) << testing::PrintToString(a.file.remarks);
  EXPECT_TRUE(a.head_points.empty());
}

TEST_F(HeadMarksOfASession, AllThatAreFarOffAreAFault) {
  auto head = places();
  for (auto& [point, q] : head) q += Vec2(0.09, -0.09);
  const auto a = aligned(target(session(3), head));
  EXPECT_TRUE(faulted(a, "what it shows of the head contradicts"))
      << testing::PrintToString(a.judgement.faults) << testing::PrintToString(a.file.remarks);
}

TEST_F(HeadMarksOfASession, OneThatTheCallerGivesFarOffIsAFault) {
  const SessionFile t = target(session(3), {});
  SessionMarks marks;
  marks.points = head_points_of(t, {{short_tendon, "150,-150"}}, true, {});
  const auto a = align(model, t, {}, {}, marks);
  EXPECT_FALSE(a.judgement.faults.empty());
}

TEST_F(HeadMarksOfASession, WhatTheModelLacksIsLeftOutOrAnErrorOfItsOption) {
  ModelParts parts = model.parts();
  parts.jaw.reset();
  const Model jawless(std::move(parts));
  const SessionFile t = target(session(3), places());
  SessionMarks marks;
  marks.points = head_points_of(t, {}, true, {});
  const auto a = align(jawless, t, {}, {}, marks);
  EXPECT_TRUE(remarks(a, "its mandible is left out: the model file has no jaw"));
  EXPECT_EQ(a.head_points.size(), 2u);
  marks.points = head_points_of(t, {{mandible, "10,20"}}, true, {});
  try {
    align(jawless, t, {}, {}, marks);
    ADD_FAILURE() << "no error";
  } catch (const InputError& e) {
    EXPECT_EQ(std::string(e.what()).find("--jaw-shadow"), 0u) << e.what();
  }
}

TEST_F(HeadMarksOfASession, APointIsTwoNumbersInTheUnitsOfTheContours) {
  SessionFile curves = target(session(3), {{hyoid, Vec2(0.1, 0.05)}});
  curves.file.units = "px";
  ReadOptions o;
  o.mm_per_px = 0.5;
  const auto points = head_points_of(curves, {{hyoid, "120,-40.5"}}, true, o);
  ASSERT_EQ(points.size(), 1u);  // what the caller gives goes before what the file names
  EXPECT_FALSE(points.at(hyoid).by_name);
  const Vec3 p = points.at(hyoid).file.file.frames.front().points.front().position;
  EXPECT_NEAR(p[0], 0.06, 1e-12);
  EXPECT_NEAR(p[2], -0.02025, 1e-12);
  for (const char* bad : {"3", "a,b", "1,2,3"})
    EXPECT_THROW(head_points_of(curves, {{hyoid, bad}}, true, o), InputError) << bad;
  EXPECT_TRUE(head_points_of(curves, {}, false, o).empty());
  curves.file.format.content = Content::sensors;
  EXPECT_THROW(head_points_of(curves, {{hyoid, "1,2"}}, false, o), InputError);
}

TEST(MiddleOfSightings, StrayOnesDoNotMoveIt) {
  std::vector<Vec2> points;
  for (int k = 0; k < 40; ++k) points.emplace_back(1e-3 * (k % 5 - 2), 1e-3 * (k % 3 - 1));
  const Middle clean = middle_of(points);
  for (int k = 0; k < 6; ++k) points.emplace_back(0.5, -0.4);
  const Middle with = middle_of(points);
  EXPECT_LT((with.point - clean.point).norm(), 1.1e-3);
  EXPECT_LT(with.spread, 3e-3);
  EXPECT_GT(with.spread, 0.5e-3);
  EXPECT_EQ(middle_of({Vec2(1, 2)}).point, Vec2(1, 2));
  EXPECT_EQ(middle_of({Vec2(1, 2)}).spread, 0);
}

}  // namespace
}  // namespace genio
