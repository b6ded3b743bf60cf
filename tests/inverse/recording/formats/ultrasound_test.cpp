// Real ultrasound, read in place; skipped where it is absent.

#include <gtest/gtest.h>

#include "forward/model/build_model.hpp"
#include "inverse/recording/frame_target.hpp"
#include "inverse/recording/session/session.hpp"
#include "inverse/shape/infer.hpp"
#include "tests/forward/small_model.hpp"

namespace genio {
namespace {

TEST(Ultrasound, FramesGetAnAnswerOrAStatedReason) {
  const std::string data = test::reference_folder();
  if (data.empty()) GTEST_SKIP() << "the reference data are not here";
  const Model m = read_model(test::generic_model());
  Workspace ws(m);
  const auto file = read_contours(data + "/ultrasound_aaa/coretta2018itapol/it01-vowel-series.tsv");
  const auto palate = read_contours(data + "/ultrasound_aaa/rticulate/it01-palate.tsv");
  EXPECT_EQ(file.frames.size(), 1013u);
  const auto r = register_by_palate(m, reach_of(m), midsagittal_points(palate).front(),
                                    midsagittal_points(file));
  EXPECT_LT(r.palate_rms, 2e-3);
  EXPECT_NEAR(r.transform.scale, 1, 0.25);  // another speaker than the model
  int answered = 0;
  for (size_t i : {size_t(20), size_t(500), size_t(900)}) {
    const Target t = make_target(m, registered(m, file.frames[i], r.transform), 1.5e-3);
    if (t.empty()) {
      EXPECT_FALSE(file.frames[i].note.empty());
      continue;
    }
    InferOptions options;
    options.deadline_s = 40;
    const auto a = infer(m, t, Prior{}, ws, options);
    EXPECT_FALSE(a.message.empty());
    if (a.status != InferStatus::converged) continue;
    ++answered;
    EXPECT_LT(a.rms, 5e-3);
    EXPECT_NE(a.verdict, Verdict::none);
  }
  EXPECT_GE(answered, 1);
}

}  // namespace
}  // namespace genio
