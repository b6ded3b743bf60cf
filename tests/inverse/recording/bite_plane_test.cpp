// A bite plane tells how the head was tilted, and one that cannot be the session's is doubted.

#include "inverse/recording/base/bite_plane.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "forward/model/build_model.hpp"
#include "inverse/recording/session/session.hpp"
#include "inverse/target/tongue_line.hpp"
#include "tests/forward/small_model.hpp"

namespace genio {
namespace {

std::vector<Vec2> line_at(double tilt, double length, double noise = 0) {
  std::vector<Vec2> points;
  for (int k = 0; k < 20; ++k) {
    const double s = length * k / 19, off = k % 2 == 0 ? noise : -noise;
    points.emplace_back(s * std::cos(tilt) - off * std::sin(tilt),
                        s * std::sin(tilt) + off * std::cos(tilt));
  }
  return points;
}

TEST(BitePlane, ItsTiltIsThatOfTheLineWhicheverEndComesFirst) {
  for (const double tilt : {-1.2, -0.3, 0.0, 0.4, 1.0}) {
    auto points = line_at(tilt, 0.03);
    EXPECT_NEAR(bite_plane_of(points, "b").tilt, tilt, 1e-9);
    std::reverse(points.begin(), points.end());
    EXPECT_NEAR(bite_plane_of(points, "b").tilt, tilt, 1e-9);
  }
  EXPECT_GT(bite_plane_of(line_at(0, 0.03, 1e-3), "b").sd, bite_plane_of(line_at(0, 0.03), "b").sd);
}

TEST(BitePlane, WhatIsNoStraightLineIsRefused) {
  EXPECT_THROW(bite_plane_of(line_at(0, 2e-3), "b"), InputError);
  EXPECT_THROW(bite_plane_of(line_at(0, 0.03, 6e-3), "b"), InputError);
  EXPECT_THROW(bite_plane_of({}, "b"), InputError);
}

class BitePlaneOfASession : public testing::Test {
 protected:
  const Model model = read_model(test::generic_model());
  const double bowed = 0.5;  // of the head in the device [rad]

  SessionFile file_of(const std::vector<Vec2>& line, double turn) const {
    SessionFile file{"f", {}, {"mm", "left", "up"}};
    file.file.model_frame = false;
    ContourFrame& frame = file.file.frames.emplace_back();
    frame.number = 1;
    for (const Vec2& q : line) {
      const Vec2 at = Similarity{1, turn, Vec2(-0.02, 0.03)}(q);
      ContourPoint& p = frame.points.emplace_back();
      p.position = {at[0], std::nan(""), at[1]}, p.kind = "curve";
    }
    return file;
  }
  SessionFile tongue() const {
    auto line = TongueLine(model).sample(model.rest, 40);
    line.erase(line.begin(), line.begin() + 8);
    return file_of(line, bowed);
  }
};

TEST_F(BitePlaneOfASession, TellsTheTiltWhereThereIsNoPalate) {
  const auto alone = align(model, tongue(), {}, {});
  const auto told =
      align(model, tongue(), {}, {}, {.bite_plane = file_of(line_at(0.03, 0.03), bowed)});
  EXPECT_NEAR(told.registration.transform.angle, -bowed, 0.06);
  EXPECT_LT(std::abs(told.registration.transform.angle + bowed),
            std::abs(alone.registration.transform.angle + bowed));
  EXPECT_LT(told.registration.tilt_sd, alone.registration.tilt_sd);
  ASSERT_TRUE(told.bite_plane);
  EXPECT_NEAR(*told.bite_plane, 0.03 + bowed + told.registration.transform.angle, 1e-9);
  EXPECT_FALSE(alone.bite_plane);
}

TEST_F(BitePlaneOfASession, OneThatThePalateContradictsIsAFault) {
  const auto cut = midsagittal_cut(*model.palate).front();
  const SessionFile palate =
      file_of({cut.begin() + long(cut.size() / 6), cut.begin() + long(2 * cut.size() / 3)}, bowed);
  const auto own =
      align(model, tongue(), palate, {}, {.bite_plane = file_of(line_at(0, 0.03), bowed)});
  EXPECT_TRUE(own.judgement.faults.empty());
  const auto other =
      align(model, tongue(), palate, {}, {.bite_plane = file_of(line_at(0.6, 0.03), bowed)});
  EXPECT_TRUE(std::any_of(other.judgement.faults.begin(), other.judgement.faults.end(),
                          [](const std::string& fault) {
                            return fault.find("bite plane is tilted") != std::string::npos;
                          }))
      << testing::PrintToString(other.judgement.faults);
}

}  // namespace
}  // namespace genio
