// What makes two inversions the same question.

#include "runs/frames/inversion.hpp"

#include <gtest/gtest.h>

#include "forward/base/text_file.hpp"
#include "forward/model/build_model.hpp"
#include "tests/forward/small_model.hpp"
#include "tests/runs/temporary_folder.hpp"

namespace genio {
namespace {

TEST(QuestionOfAnInversion, ATargetOfSeveralFilesCountsByAllTheirContents) {
  const test::TemporaryFolder folder;
  const std::string a = folder.path() + "/take.TT", b = folder.path() + "/take.TB";
  write_text(a, "tip"), write_text(b, "body");
  InversionOptions o;
  o.measured.target = a + "," + b;
  const std::string before = question_json(question_of(o, 1e-3));
  EXPECT_EQ(difference(before, question_json(question_of(o, 1e-3))), "");
  write_text(b, "another body");
  EXPECT_NE(difference(before, question_json(question_of(o, 1e-3))).find("target"),
            std::string::npos);
}

TEST(QuestionOfAnInversion, PointsOfTheHeadAreAskedAlong) {
  const InversionOptions plain;
  const std::string before = question_json(question_of(plain, 1e-3));
  const auto other = [&](const auto& change) {
    InversionOptions o;
    change(o.measured);
    return difference(before, question_json(question_of(o, 1e-3)));
  };
  EXPECT_NE(other([](auto& m) { m.hyoid = "1,2"; }), "");
  EXPECT_NE(other([](auto& m) { m.short_tendon = "1,2"; }), "");
  EXPECT_NE(other([](auto& m) { m.jaw_shadow = "1,2"; }), "");
  EXPECT_NE(other([](auto& m) { m.ignore_marks = true; }), "");
}

TEST(QuestionOfAnInversion, AMovementTakesTheHeadsPlaceFromAPalateOnly) {
  const Model model = read_model(test::generic_model());
  const HeadPosePrior open{2e-3, 0.05};
  InversionOptions o;
  EXPECT_TRUE(frame_options(model, o, open).prior.head_pose);
  o.dynamic = true;
  EXPECT_THROW(frame_options(model, o, open), InputError);
  EXPECT_FALSE(frame_options(model, o, {}).prior.head_pose);
  o.measured.palate = "palate.csv";
  EXPECT_FALSE(frame_options(model, o, open).prior.head_pose);
}

}  // namespace
}  // namespace genio
