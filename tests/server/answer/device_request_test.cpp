// Points in a device's frame are laid beside the model as recordings are, or refused in words.

#include <cmath>
#include <nlohmann/json.hpp>

#include "forward/base/elapsed.hpp"
#include "inverse/recording/frame_target.hpp"
#include "tests/server/answer/asked.hpp"

namespace genio {
namespace {

using test::device_request;
using test::expect_same;
using test::force_in;
using test::put_point;

class DeviceRequest : public test::AskedTest {};

/// The same as a request with the numbers of a reply.
shape_request_t placed_as(const command_reply_t& reply, shape_request_t r) {
  r.frame = "placed";
  r.palate_x_mm.clear(), r.palate_z_mm.clear(), r.palate_count = 0;
  r.scale = reply.scale, r.tilt_deg = reply.tilt_deg;
  r.shift_x_mm = reply.shift_x_mm, r.shift_z_mm = reply.shift_z_mm;
  r.shift_sd_mm = reply.shift_sd_mm, r.tilt_sd_deg = reply.tilt_sd_deg;
  return r;
}

/// The points and the palate, along and up multiplied.
shape_request_t stretched(shape_request_t r, double along, double up) {
  for (auto* x : {&r.x_mm, &r.palate_x_mm})
    for (double& v : *x) v *= along;
  for (auto* z : {&r.z_mm, &r.palate_z_mm})
    for (double& v : *z) v *= up;
  return r;
}

TEST_F(DeviceRequest, IsLaidBesideTheModelByItsPalate) {
  const command_reply_t reply = answer(device_request(3));
  ASSERT_EQ(reply.status, "converged") << reply.message;
  EXPECT_EQ(reply.verdict, "explained") << reply.message;
  const auto json = nlohmann::json::parse(reply.registration);
  EXPECT_EQ(json["by"], "palate");
  EXPECT_FALSE(json["doubtful"]);
  EXPECT_LT(json["palate_rms_mm"], 1);
  EXPECT_NEAR(reply.scale, 1, 0.05);
  EXPECT_NEAR(std::abs(reply.tilt_deg), 12, 3);
  EXPECT_DOUBLE_EQ(json["tilt_deg"], reply.tilt_deg);
  EXPECT_GT(reply.shift_sd_mm, 0);
  EXPECT_EQ(reply.other,
            (std::vector<std::string>{"head_pose.x", "head_pose.z", "head_pose.turn"}));
  EXPECT_EQ(reply.other_unit, (std::vector<std::string>{"m", "m", "rad"}));
  EXPECT_NEAR(force_in(reply, "STY"), 1, 0.5);  // what made it
}

TEST_F(DeviceRequest, PlacedByTheNumbersOfItsReplyItIsAnsweredAlike) {
  for (const bool palate : {true, false}) {
    const shape_request_t request = device_request(2, palate);
    const command_reply_t first = answer(request), second = answer(placed_as(first, request));
    expect_same(first, second);
    EXPECT_NEAR(first.scale, second.scale, 1e-12);
    EXPECT_NEAR(first.shift_sd_mm, second.shift_sd_mm, 1e-9);
    EXPECT_EQ(nlohmann::json::parse(second.registration)["by"], "given");
  }
}

TEST_F(DeviceRequest, WithoutAPalateTheContourAloneTellsLess) {
  const command_reply_t with = answer(device_request(1)), alone = answer(device_request(1, false));
  ASSERT_EQ(alone.status, "converged") << alone.message;
  EXPECT_EQ(nlohmann::json::parse(alone.registration)["by"], "contours");
  EXPECT_GT(alone.shift_sd_mm, with.shift_sd_mm);
  EXPECT_EQ(alone.other_count, 3);
}

TEST_F(DeviceRequest, ThePriorTellsOfTheHeadWhereItDoes) {
  shape_request_t request = device_request(1);
  request.prior = "[head_pose]\nshift_sd_mm = 0.01\nturn_sd_deg = 0.01\n";
  const command_reply_t reply = answer(request);
  ASSERT_EQ(reply.status, "converged") << reply.message;
  EXPECT_LT(std::abs(reply.other_value.at(0)), 0.05e-3);
  EXPECT_LE(reply.other_sd.at(0), 0.011e-3);
}

TEST_F(DeviceRequest, MirroredTurnedOrInOtherUnitsItFailsInWords) {
  for (const bool palate : {true, false})
    for (const auto& [along, up] :
         {std::pair(-1.0, 1.0), {1, -1}, {-1, -1}, {1e-3, 1e-3}, {10, 10}})
      for (const int frame : {1, 2, 3, 4}) {
        const auto reply = answer(stretched(device_request(frame, palate), along, up));
        EXPECT_EQ(reply.status, "failed") << along << " " << up << " " << frame << palate;
        EXPECT_NE(reply.message, "");
        EXPECT_EQ(reply.muscle_count, 0);
      }
  const auto reply = answer(stretched(device_request(1), -1, 1));
  EXPECT_NE(reply.message.find("cannot be laid beside the model"), std::string::npos);
  const auto json = nlohmann::json::parse(reply.registration);
  EXPECT_TRUE(json["doubtful"]);
  EXPECT_FALSE(json["forced"]);
  EXPECT_NE(reply.message.find(json["reason"]), std::string::npos) << reply.message;
}

TEST_F(DeviceRequest, SurfacePointsAreRefusedByNumber) {
  shape_request_t request = device_request(1);
  request.kind[4] = "surface", request.y_mm[4] = 1;
  const command_reply_t reply = answer(request);
  EXPECT_EQ(reply.status, "failed");
  EXPECT_NE(reply.message.find("point 5: a surface point"), std::string::npos) << reply.message;
}

/// Sensors that are glued where the tongue at rest has these places, and called `names`, in a
/// device whose numbers lie 10 mm farther back and 5 mm higher. The model's palate lies there, too.
shape_request_t sensors(const Model& m, const std::vector<std::string>& places,
                        const std::vector<std::string>& names) {
  shape_request_t r = test::blank_request();
  r.frame = "device";
  for (size_t k = 0; k < places.size(); ++k) {
    const Vec3 at = 1e3 * place_at_rest(m, places[k]);
    put_point(r, {at[0] + 10, std::nan(""), at[2] + 5}, names[k], 0.5);
  }
  const auto cut = midsagittal_cut(*m.palate);
  for (const Eigen::Vector2d& q : cut.front())
    r.palate_x_mm.push_back(1e3 * q[0] + 10), r.palate_z_mm.push_back(1e3 * q[1] + 5);
  r.palate_count = int(r.palate_x_mm.size());
  return r;
}

TEST_F(DeviceRequest, SensorsAreRegisteredAndInAnotherOrderRefused) {
  const std::vector<std::string> places = {"tip", "blade", "dorsum"};
  const command_reply_t reply = answer(sensors(model(), places, places));
  ASSERT_EQ(reply.status, "converged") << reply.message;
  EXPECT_NEAR(reply.shift_x_mm, -10, 2);
  EXPECT_NEAR(reply.shift_z_mm, -5, 2);
  const auto turned = answer(sensors(model(), places, {"dorsum", "blade", "tip"}));
  EXPECT_EQ(turned.status, "failed");
  EXPECT_NE(turned.message, "");
}

TEST_F(DeviceRequest, NumbersThatPlaceItWhereNoTongueIsGiveNoVerdict) {
  const shape_request_t request = device_request(1);
  shape_request_t away = placed_as(answer(request), request);
  away.shift_x_mm += 40, away.starts = 1;
  const command_reply_t reply = answer(away);
  EXPECT_TRUE(nlohmann::json::parse(reply.registration)["forced"]);
  EXPECT_EQ(reply.verdict, "none") << reply.message;
  EXPECT_NE(reply.message.find("doubtful"), std::string::npos) << reply.message;
}

TEST_F(DeviceRequest, APlaceIsKnownExactlyOrWithinBoth) {
  const shape_request_t request = device_request(1);
  shape_request_t exact = placed_as(answer(request), request);
  exact.shift_sd_mm = exact.tilt_sd_deg = 0;
  const command_reply_t reply = answer(exact);
  EXPECT_EQ(reply.status, "converged") << reply.message;
  EXPECT_EQ(reply.other_count, 0);
  for (const double wrong : {-1.0, std::nan(""), HUGE_VAL}) {
    exact.shift_sd_mm = wrong;
    EXPECT_NE(answer(exact).message.find("shift_sd_mm and tilt_sd_deg"), std::string::npos)
        << wrong;
  }
  exact.shift_sd_mm = exact.tilt_sd_deg = 1e300, exact.starts = 1;
  EXPECT_NE(answer(exact).status, "");
  exact.shift_sd_mm = 1, exact.tilt_sd_deg = 0;
  EXPECT_NE(answer(exact).message.find("expected both above 0"), std::string::npos);
}

TEST_F(DeviceRequest, PlacedSurfacePointsAreScaledAcrossAsWell) {
  // The surface at rest in larger numbers, and in the model's own.
  shape_request_t larger = test::blank_request();
  larger.starts = 1;
  shape_request_t own = larger;
  larger.frame = "placed", larger.scale = 0.8;
  for (size_t k = 0; k < model().surface.size(); k += 3) {
    const Vec3 p = 1e3 * model().mesh.nodes[size_t(model().surface[k][0])];
    put_point(own, p, "surface", 1), put_point(larger, 1.25 * p, "surface", 1);
  }
  const command_reply_t placed = answer(larger), reply = answer(own);
  ASSERT_EQ(placed.status, "converged") << placed.message;
  EXPECT_NEAR(placed.rms_mm, reply.rms_mm, 1e-3);
  EXPECT_FALSE(nlohmann::json::parse(placed.registration)["doubtful"]);
}

TEST_F(DeviceRequest, TheRegistrationCountsForTheDeadline) {
  const command_reply_t reply = answer(device_request(1), 1e-6);
  EXPECT_EQ(reply.status, "deadline");
  EXPECT_NE(reply.message.find("before the first step"), std::string::npos) << reply.message;
  EXPECT_EQ(reply.registration, "");  // which had only begun
}

/// A hook that is asked whether the request is still wanted, until `most` times.
struct Withdrawal {
  int asked = 0, most;
  command_reply_t answer(const Model& model, RequestWorker& worker, const shape_request_t& r) {
    RequestHooks hooks;
    hooks.cancelled = [this] { return ++asked >= most; };
    return answer_request(model, r, 0, worker, hooks).reply;
  }
};

TEST_F(DeviceRequest, WhoeverWithdrawsItWaitsForOneStepOfTheSearch) {
  RequestWorker fresh(model());
  // Among the shapes that tell the reach, and in the registration after it.
  for (const int most : {1, 2, 5, 40, 200}) {
    Withdrawal withdrawal{.most = most};
    const command_reply_t reply = withdrawal.answer(model(), fresh, device_request(1));
    EXPECT_EQ(reply.status, "cancelled") << most << ": " << reply.message;
    EXPECT_EQ(reply.registration, "") << most;
    EXPECT_LE(withdrawal.asked, most + 1);  // once more where NLopt had ended the search
  }
  EXPECT_EQ(answer_request(model(), device_request(3), 0, fresh).reply.status, "converged");
}

// What a watchdog takes for a sign of life, see WorkerPipe::withdrawn().
TEST_F(DeviceRequest, WhileItIsRegisteredItShowsThatTheWorkGoesOn) {
  double longest_s = 0;
  RequestHooks hooks;
  Stopwatch since;
  hooks.cancelled = [&] {
    longest_s = std::max(longest_s, since.seconds()), since = {};
    return false;
  };
  RequestWorker fresh(model());
  since = {};
  answer_request(model(), device_request(1), 0, fresh, hooks);
  EXPECT_LT(longest_s, 10);  // a minute ends a worker
}

TEST_F(DeviceRequest, WhatIsPreparedNeedsNoFurtherSolves) {
  RequestWorker idle(model()), busy(model());
  int asked = 0;
  idle.prepare([&] { return ++asked > 3; });  // ends in the middle, and begins anew
  idle.prepare([&, left = 60]() mutable { return --left < 0; });
  Withdrawal prepared{.most = 1 << 30}, fresh{.most = 1 << 30};
  const auto one = prepared.answer(model(), idle, device_request(1));
  const auto other = fresh.answer(model(), busy, device_request(1));
  EXPECT_LT(prepared.asked, fresh.asked);
  EXPECT_EQ(one.registration, other.registration);
}

}  // namespace
}  // namespace genio
