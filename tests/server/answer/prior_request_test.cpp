// A prior that is sent counts as that of a file, and says what is wrong with it as one does.

#include <fmt/format.h>

#include <cmath>

#include "inverse/prior/prior_file.hpp"
#include "inverse/recording/frame_target.hpp"
#include "inverse/search/multi_start.hpp"
#include "inverse/target/tongue_line.hpp"
#include "tests/server/answer/asked.hpp"

namespace genio {
namespace {

using test::force_in;
using test::put_point;

class PriorRequest : public test::AskedTest {
 protected:
  /// The tongue at rest, nearly.
  static shape_request_t request(const std::string& prior) {
    shape_request_t r = test::blank_request();
    r.prior = prior;
    for (const Vec2& q : TongueLine(model()).sample(model().rest, 20))
      put_point(r, 1e3 * Vec3(q[0], std::nan(""), q[1]), "curve", 1);
    return r;
  }
  static std::string complaint(const std::string& prior) {
    const command_reply_t reply = answer(request(prior));
    EXPECT_EQ(reply.status, "failed") << prior;
    return reply.message;
  }
};

const char* const believed =
    "effort_sd = 0.2\nsymmetry_sd = 0.05\n[emg.GGP]\nmean = 0.1\nsd = 0.01\n"
    "[cocontraction]\nmean = 0.05\nsd = 0.02\n[fixed_N]\nMH = 0.5\n[head_pose]\n"
    "shift_sd_mm = 0.5\nturn_sd_deg = 1\n";

TEST_F(PriorRequest, CountsAsInTheLibrary) {
  const command_reply_t reply = answer(request(believed));
  ASSERT_EQ(reply.status, "converged") << reply.message;
  ContourFrame frame;
  for (const Vec2& q : TongueLine(model()).sample(model().rest, 20))
    frame.points.push_back({Vec3(q[0], std::nan(""), q[1]), 1e-3, "curve"});
  InferWorkspace ws(model());
  const Answer own = infer_from_starts(model(), make_target(model(), frame, point_noise),
                                       prior_of_text("text", believed), ws);
  ASSERT_EQ(reply.muscle.size(), own.muscles.size());
  for (size_t k = 0; k < own.muscles.size(); ++k)
    EXPECT_NEAR(reply.force_N[k], own.muscles[k].best, 1e-4 * own.muscles[k].maximum);
  EXPECT_NEAR(force_in(reply, "MH"), 0.5, 1e-9);
  ASSERT_EQ(size_t(reply.other_count), own.others.size());
  for (size_t k = 0; k < own.others.size(); ++k) {
    EXPECT_EQ(reply.other[k], own.others[k].name);
    EXPECT_EQ(reply.other_unit[k], own.others[k].unit);
    EXPECT_NEAR(reply.other_value[k], own.others[k].best, 0.01 * own.others[k].sd);
    EXPECT_NEAR(reply.other_low[k], own.others[k].low, 0.1 * own.others[k].sd);
  }
}

TEST_F(PriorRequest, APointInTheModelsFrameHasNoPlaceToTell) {
  const command_reply_t reply = answer(request(""));
  ASSERT_EQ(reply.status, "converged") << reply.message;
  EXPECT_EQ(reply.registration, "");
  EXPECT_TRUE(std::isnan(reply.scale) && std::isnan(reply.shift_z_mm));
  EXPECT_EQ(reply.other_count, 0);
}

TEST_F(PriorRequest, SaysWhatIsWrongAndInWhichLine) {
  for (const auto& [text, expected] :
       {std::pair("effort = 1", "prior, line 1: unknown key 'effort'; did you mean effort_sd"),
        {"\n\neffort_sd = -1", "prior, line 3: 'effort_sd' must be above 0"},
        {"[emg.GGP]\nmean = 2\nsd = 1\n", "prior, line 1: 'GGP': 'mean' must be an activation"},
        {"effort_sd = 1\n=", "prior, line 2: "},
        {"[fixed_N]\nMX = 1", "prior: fixed MX: no such muscle"},
        {"[parameter.\"jaw.angle\"]\nmean = 1\nsd = 1", "prior: "},
        {"effort_sd = \"a\"", "prior, line 1: 'effort_sd' must be a finite number"}})
    EXPECT_EQ(complaint(text).substr(0, std::string(expected).size()), expected) << complaint(text);
}

TEST_F(PriorRequest, MayNameNoFile) {
  for (const char* path : {"emg.csv", "/etc/passwd", "../../data/examples/prior/emg.csv"})
    EXPECT_EQ(complaint(fmt::format("emg = \"{}\"", path)),
              "prior, line 1: 'emg' names a file, and a text that was sent can name none; expected "
              "[emg.MUSCLE] with mean and sd");
}

TEST_F(PriorRequest, HostileTextsGetShortReasons) {
  std::string nested = "x = ", dotted = "a";
  for (int k = 0; k < 30000; ++k) nested += '[', dotted += ".a";
  for (const std::string& text :
       {nested, dotted + " = 1", std::string(60000, 'k') + " = 1", std::string(70000, '#'),
        "\"" + std::string(2000, 'k') + "\\u00e4\\u001b[31m\\n\" = 1", std::string("\0\xff", 2),
        "[fixed_N]\n\"" + std::string(60000, 'M') + "\" = 1"}) {
    const std::string said = complaint(text);
    EXPECT_EQ(said.find("prior"), 0u) << said;
    EXPECT_LE(said.size(), 2003u);
    for (const char c : said) EXPECT_FALSE(c >= 0 && c < ' ') << int(c);
  }
}

TEST_F(PriorRequest, NumbersThatNobodyMeansAreRefusedByLine) {
  for (const char* text :
       {"effort_sd = 1e-300", "effort_sd = 1e300", "symmetry_sd = 5e-324",
        "[cocontraction]\nmean = 1e308\nsd = 0.1", "[head_pose]\nshift_sd_mm = 1e300",
        "[emg.GGP]\nmean = 1\nsd = 1e-300", "[head_pose]\nturn_sd_deg = 1e300",
        "[parameter.\"elasticity.a10\"]\nmean = 1000\nsd = 1e300"})
    EXPECT_EQ(complaint(text).find("prior, line "), 0u) << complaint(text);
}

TEST_F(PriorRequest, WhatLosesAllDigitsEndsInAReply) {
  for (const char* text :
       {"effort_sd = 1e-9", "effort_sd = 1e12", "[cocontraction]\nmean = 1\nsd = 1e-9",
        "[head_pose]\nshift_sd_mm = 1e12", "[head_pose]\nturn_sd_deg = 1e12",
        "[head_pose]\nshift_sd_mm = 1e-9", "[emg.GGP]\nmean = 1\nsd = 1e-9",
        "[parameter.\"elasticity.a10\"]\nmean = 1000\nsd = 1e-9",
        "[parameter.\"elasticity.a10\"]\nmean = 1000\nsd = 1e12",
        "effort_sd = 1e-9\n[emg.GGP]\nmean = 1\nsd = 1e12"}) {
    shape_request_t r = request(text);
    r.starts = 1;
    const command_reply_t reply = answer(r, 20);
    EXPECT_TRUE(reply.status == "converged" || !reply.message.empty()) << text;
    for (const double force : reply.force_N) EXPECT_TRUE(std::isfinite(force)) << text;
  }
}

}  // namespace
}  // namespace genio
