// Runs of frames on the tongue itself: what is known of the frame before is used, nothing is lost.

#include "runs/frames/frame_by_frame.hpp"

#include <gtest/gtest.h>

#include "tests/inverse/pulled_tongue.hpp"

namespace genio {
namespace {

class FrameByFrameRun : public test::PulledTongue {
 protected:
  std::vector<Frame> frames(int count) {
    std::vector<Frame> result;
    for (int k = 0; k < count; ++k) {
      Frame frame;
      frame.contour.number = k + 1;
      frame.target = pulled({{"GGP", 2 + 0.1 * k}}, 12, 0.5e-3);
      result.push_back(std::move(frame));
    }
    return result;
  }
  static std::string message(const ContourFrame& frame, const AnswerView& view, const Positions&) {
    return answer_json(view, frame.number);
  }
};

TEST_F(FrameByFrameRun, TwoProcessesAnswerEveryFrameOnceAsOneDoesItsOwn) {
  const auto all = frames(2);
  AnswerRecords one, two;
  const auto run = [&](int processes, AnswerRecords& answers) {
    answer_in_processes(m, all, {}, {}, processes, message, [&](const std::string& line) {
      const auto r = read_record(line).value();
      EXPECT_TRUE(answers.emplace(r.frame, r).second);
    });
  };
  run(1, one);
  run(2, two);
  ASSERT_EQ(one.size(), 2u);
  ASSERT_EQ(two.size(), 2u);
  // The second starts elsewhere in two processes.
  EXPECT_EQ(one.at(1).forces_N, two.at(1).forces_N);
}

TEST_F(FrameByFrameRun, AResumedRunGoesOnWhereTheFrameBeforeEnded) {
  const auto all = frames(2);
  AnswerRecords whole, resumed;
  answer_in_processes(m, all, {}, {}, 1, message, [&](const std::string& line) {
    const auto r = read_record(line).value();
    whole[r.frame] = r;
  });
  const AnswerRecords known = {{1, whole.at(1)}};
  answer_in_processes(m, open_frames(all, known), {}, known, 1, message,
                      [&](const std::string& line) {
                        const auto r = read_record(line).value();
                        resumed[r.frame] = r;
                      });
  ASSERT_EQ(resumed.size(), 1u);
  EXPECT_TRUE(resumed.at(2).converged());
  for (const auto& [muscle, force] : whole.at(2).forces_N)
    EXPECT_NEAR(resumed.at(2).forces_N.at(muscle), force, 0.02) << muscle;
}

TEST_F(FrameByFrameRun, AFrameWithoutPointsSaysWhy) {
  Frame empty;
  empty.contour.number = 3, empty.contour.note = "the tracker lost it";
  AnswerView seen;
  InferWorkspace worker(m);
  answer_frames(m, {empty}, {}, std::nullopt, worker,
                [&](const ContourFrame&, const AnswerView& view, const Positions& shape) {
                  seen = view;
                  EXPECT_EQ(shape.size(), 0);
                });
  EXPECT_EQ(seen.status, "failed");
  EXPECT_EQ(seen.message, "the tracker lost it");
}

}  // namespace
}  // namespace genio
