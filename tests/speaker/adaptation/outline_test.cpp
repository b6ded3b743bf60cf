// Outlines are read as their columns say, turned where that is certain, and refused with a reason.

#include "speaker/adaptation/outline_of_model.hpp"
#include "speaker/outline/outline_checks.hpp"
#include "speaker/outline/outline_facing.hpp"
#include "speaker/outline/rigid_frame.hpp"
#include "tests/forward/small_model.hpp"
#include "tests/speaker/shapes.hpp"

namespace genio {
namespace {

using test::complaint;
using test::ScratchFolder;

SpeakerOutline generic_outline(const std::function<Vec2(const Vec2&)>& map = [](const Vec2& p) {
  return p;
}) {
  return outline_of_model(read_description(test::generic_model()), map, 1.5e-3);
}

/// What is wrong with an outline that was read.
std::string refusal(const SpeakerOutline& o) {
  return complaint([&] {
    check_outline_size(o);
    check_outline(facing_model(o));
  });
}

TEST(Outline, ReadsCentimetresAndMillimetresAlike) {
  const ScratchFolder folder;
  const auto cm = folder.write("cm.csv", "segment,point,x_cm,y_cm\ntongue,0,1,2\ntongue,1,1.5,2\n");
  const auto mm = folder.write("mm.csv",
                               "speaker,segment,point,x_mm,y_mm,z_mm\n"
                               "a,tongue,0,10,0,20\na,tongue,1,15,0,20\n");
  for (const std::string& path : {cm, mm}) {
    const SpeakerOutline o = read_outline(path);
    ASSERT_EQ(o.tongue().size(), 2u);
    EXPECT_NEAR((o.tongue()[1] - Vec2(0.015, 0.02)).norm(), 0, 1e-12) << path;
  }
}

TEST(Outline, OfSeveralSpeakersNeedsAChoice) {
  const ScratchFolder folder;
  const auto path = folder.write("two.csv",
                                 "speaker,segment,point,x_cm,y_cm\n1,tongue,0,1,2\n1,tongue,1,2,2\n"
                                 "7,tongue,0,3,2\n7,tongue,1,4,2\n");
  EXPECT_NE(complaint([&] { read_outline(path); }).find("one of 1, 7"), std::string::npos);
  EXPECT_NE(complaint([&] { read_outline(path, "3"); }).find("one of 1, 7"), std::string::npos);
  EXPECT_NEAR(read_outline(path, "7").tongue()[0][0], 0.03, 1e-12);
}

TEST(Outline, ComplaintsNameFileRowAndWhatWasExpected) {
  const ScratchFolder folder;
  const auto said = [&](const std::string& text) {
    const auto path = folder.write("bad.csv", text);
    const std::string reason = complaint([&] { read_outline(path); });
    EXPECT_NE(reason.find("bad.csv"), std::string::npos) << reason;
    return reason;
  };
  EXPECT_NE(said("segment,point,x,y\n").find("x_cm"), std::string::npos);
  EXPECT_NE(said("segment,point,x_cm,y_cm\ntongue,1,1,2\ntongue,0,1,2\n").find(":3"),
            std::string::npos);
  EXPECT_NE(said("segment,point,x_cm,y_cm\ntongue,1,one,2\n").find("x_cm"), std::string::npos);
  EXPECT_NE(said("segment,point,x_cm,y_cm\npalate,1,1,2\npalate,2,1,3\n").find("no segment tongue"),
            std::string::npos);
}

TEST(Outline, ThatFacesTheOtherWayIsTurnedWhereBonesTell) {
  const SpeakerOutline straight = facing_model(generic_outline());
  EXPECT_TRUE(straight.notes.empty());
  const SpeakerOutline turned =
      facing_model(generic_outline([](const Vec2& p) { return Vec2(-p[0], p[1]); }));
  ASSERT_EQ(turned.notes.size(), 1u);
  ASSERT_EQ(turned.tongue().size(), straight.tongue().size());
  for (size_t k = 0; k < straight.tongue().size(); ++k)
    EXPECT_LT((turned.tongue()[k] - straight.tongue()[k]).norm(), 1e-12);
}

TEST(Outline, WrittenFromItsRootIsTurnedAbout) {
  SpeakerOutline o = generic_outline();
  std::reverse(o.segments[Segment::tongue].begin(), o.segments[Segment::tongue].end());
  EXPECT_LT((facing_model(o).tongue().front() - generic_outline().tongue().front()).norm(), 1e-12);
}

TEST(Outline, IsRefusedWithTheReason) {
  EXPECT_EQ(refusal(generic_outline()), "");
  EXPECT_NE(refusal(generic_outline([](const Vec2& p) { return Vec2(10 * p); })).find("units"),
            std::string::npos);
  EXPECT_NE(refusal(generic_outline([](const Vec2& p) { return Vec2(p[0], -p[1]); })), "");
  SpeakerOutline few = generic_outline();
  few.segments[Segment::tongue].resize(5);
  EXPECT_NE(refusal(few).find("12 or more"), std::string::npos);
  SpeakerOutline crossing = generic_outline();
  std::swap(crossing.segments[Segment::tongue][40], crossing.segments[Segment::tongue][46]);
  EXPECT_NE(refusal(crossing).find("crosses itself"), std::string::npos);
  SpeakerOutline low = generic_outline();
  for (Vec2& p : low.segments[Segment::palate]) p[1] -= 0.02;
  EXPECT_NE(refusal(low).find("palate"), std::string::npos);
  SpeakerOutline open = generic_outline();
  auto& line = open.segments[Segment::tongue];
  line.erase(line.begin() + 30, line.begin() + 45);
  EXPECT_NE(refusal(open).find("gap"), std::string::npos);
}

TEST(RigidFrame, UndoesARigidMotion) {
  const ModelDescription model = read_description(test::generic_model());
  const Similarity away{1, 0.15, Vec2(0.03, -0.05)};
  const SpeakerOutline moved = generic_outline([&](const Vec2& p) { return away(p); });
  const Similarity back = rigid_frame(moved, model);
  EXPECT_EQ(back.scale, 1);
  EXPECT_NEAR(back.angle, -0.15, 0.01);
  for (const Vec2& p : generic_outline().tongue()) EXPECT_LT((back(away(p)) - p).norm(), 1e-3);
}

}  // namespace
}  // namespace genio
