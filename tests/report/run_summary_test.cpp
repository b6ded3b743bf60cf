#include "report/answers/run_summary.hpp"

#include "tests/report/markup.hpp"

namespace genio {
namespace {

TEST(RunSummary, HasARowAFrameWithItsTimeAndWords) {
  AnswerView view;
  view.status = "converged", view.verdict = "explained";
  view.time_s = 1.25, view.label = "a, \"long\"", view.recording = "take", view.speaker = "S2";
  view.registration = R"({"scale": 0.9, "tilt_deg": -5, "doubtful": true, "by": "palate",
    "shift_mm": [4, -2], "units": "mm", "axes": "face right, y up",
    "points_order": "tip to root"})";
  view.muscles = {{.name = "GGP",
                   .best = 2,
                   .maximum = 30,
                   .acts = 0.75,
                   .median = 1.5,
                   .sd = 0.5,
                   .low = 1,
                   .high = 3}};
  AnswerRecords answers;
  answers[3] = read_record(answer_json(view, 3)).value();
  AnswerView failed;
  failed.status = "failed", failed.verdict = "none";
  answers[4] = read_record(answer_json(failed, 4)).value();
  const test::Folder folder;
  write_summary(answers, folder.path());
  EXPECT_EQ(test::content(folder / "summary.csv"),
            "frame,time_s,label,recording,speaker,status,verdict,registration_scale,"
            "registration_tilt_deg,registration_palate_rms_mm,registration_doubtful,"
            "registration_forced,registration_by,registration_shift_back_mm,"
            "registration_shift_up_mm,registration_from_rest_mm,registration_off_reach_mm,"
            "registration_behind_palate,registration_units,registration_axes,"
            "registration_points_order,rms_mm,max_mm,chi2_per_dof,"
            "GGP_N,GGP_sd_N,GGP_acts,GGP_median_N,GGP_low90_N,GGP_high90_N\n"
            "3,1.25,\"a, "
            "\"\"long\"\"\",take,S2,converged,explained,0.9,-5,,yes,no,palate,4,-2,,,,mm,\"face "
            "right, y up\",tip to root,0,0,0,2,0.5,0.75,1.5,1,3\n"
            "4,,,,,failed,none,,,,no,no,,,,,,,,,,,,,,,,,,\n");
}

}  // namespace
}  // namespace genio
