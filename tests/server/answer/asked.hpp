#pragma once
// Requests as clients send them, of the shipped examples, and their answers without any transport.

#include <gtest/gtest.h>

#include "forward/model/build_model.hpp"
#include "runs/frames/measured.hpp"
#include "server/answer/answer_request.hpp"
#include "tests/forward/small_model.hpp"

namespace genio::test {

/// One model and one worker for all tests of a suite.
class AskedTest : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    model_ = new Model(read_model(generic_model()));
    worker_ = new RequestWorker(*model_);
  }
  static void TearDownTestSuite() {
    delete worker_;
    delete model_;
    worker_ = nullptr, model_ = nullptr;
  }
  static const Model& model() { return *model_; }
  static command_reply_t answer(const shape_request_t& r, double deadline_s = 0,
                                const RequestHooks& hooks = {}) {
    return answer_request(*model_, r, deadline_s, *worker_, hooks).reply;
  }

 private:
  static inline Model* model_ = nullptr;
  static inline RequestWorker* worker_ = nullptr;
};

/// A request for points that are put in later.
inline shape_request_t blank_request() {
  shape_request_t r{};
  r.id = "id", r.client = "client", r.bilateral = -1;
  return r;
}

inline void put_point(shape_request_t& r, const Vec3& p_mm, const std::string& kind,
                      double sigma_mm = 0) {
  r.x_mm.push_back(p_mm[0]), r.y_mm.push_back(p_mm[1]), r.z_mm.push_back(p_mm[2]);
  r.sigma_mm.push_back(sigma_mm), r.kind.push_back(kind);
  r.point_count = int(r.x_mm.size());
}

/// Of points in metres.
inline void put_points(shape_request_t& r, const ContourFrame& frame, double noise) {
  r.default_sigma_mm = 1e3 * noise;
  for (const ContourPoint& p : frame.points) put_point(r, 1e3 * p.position, p.kind, 1e3 * p.sigma);
}

/// Frame `number` of the recording in data/examples, x backwards and z up, with or without its
/// palate.
inline shape_request_t device_request(int number, bool palate = true) {
  const std::string folder = std::string(GENIO_SOURCE_DIR) + "/data/examples/recording/";
  MeasuredOptions o;
  o.target = folder + "contours.tsv", o.palate = folder + "palate.tsv";
  o.choice.frames = std::to_string(number);
  const Unregistered u = read_unregistered(o, [](const std::string&) {});
  shape_request_t r = blank_request();
  r.frame = "device";
  put_points(r, u.frames.at(0), u.noise);
  if (palate)
    for (const Vec2& q : u.palate)
      r.palate_x_mm.push_back(1e3 * q[0]), r.palate_z_mm.push_back(1e3 * q[1]);
  r.palate_count = int(r.palate_x_mm.size());
  return r;
}

/// The force of a muscle [N].
inline double force_in(const command_reply_t& r, const std::string& muscle) {
  for (size_t k = 0; k < r.muscle.size(); ++k)
    if (r.muscle[k] == muscle) return r.force_N[k];
  ADD_FAILURE() << muscle << ": " << r.status << ": " << r.message;
  return 0;
}

/// Both tell the same of forces and of what is estimated along, up to the noise of rounding.
inline void expect_same(const command_reply_t& a, const command_reply_t& b) {
  ASSERT_EQ(a.status, "converged") << a.message;
  EXPECT_EQ(a.status, b.status) << b.message;
  EXPECT_EQ(a.verdict, b.verdict);
  ASSERT_EQ(a.muscle, b.muscle);
  for (size_t k = 0; k < a.muscle.size(); ++k) {
    EXPECT_NEAR(a.force_N[k], b.force_N[k], 1e-4 * a.max_force_N[k]) << a.muscle[k];
    EXPECT_NEAR(a.low_N[k], b.low_N[k], 1e-3 * a.max_force_N[k]) << a.muscle[k];
    EXPECT_NEAR(a.high_N[k], b.high_N[k], 1e-3 * a.max_force_N[k]) << a.muscle[k];
  }
  ASSERT_EQ(a.other, b.other);
  for (size_t k = 0; k < a.other.size(); ++k)
    EXPECT_NEAR(a.other_value[k], b.other_value[k], 0.02 * a.other_sd[k]) << a.other[k];
}

}  // namespace genio::test
