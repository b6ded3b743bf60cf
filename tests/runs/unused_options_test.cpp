// Options of how a file is read that do not apply are refused by name.

#include "runs/frames/unused_options.hpp"

#include <gtest/gtest.h>

namespace genio {
namespace {

const FormatTraits curves{.name = "aaa"}, sensors{.name = "ema", .content = Content::sensors},
    own{.name = "csv"};

std::string refusal(const MeasuredOptions& o, const FormatTraits& format, bool registered) {
  try {
    refuse_unused(o, format, registered);
  } catch (const InputError& e) {
    return e.what();
  }
  return "none";
}

MeasuredOptions with(void (*set)(MeasuredOptions&)) {
  MeasuredOptions o;
  o.target = "file";
  set(o);
  return o;
}

struct Case {
  const char* option;
  MeasuredOptions options;
  bool for_curves, for_sensors, for_own;
};

std::vector<Case> cases() {
  return {
      {"none", with([](auto&) {}), true, true, true},
      {"--sensors", with([](auto& o) { o.sensors = {"3=tip"}; }), false, true, false},
      {"--rate-hz", with([](auto& o) { o.read.rate_hz = 200; }), false, true, false},
      {"--units", with([](auto& o) { o.read.units = "cm"; }), true, true, false},
      {"--mm-per-px", with([](auto& o) { o.read.mm_per_px = 0.2; }), true, true, false},
      {"--facing", with([](auto& o) { o.read.facing = "left"; }), true, true, false},
      {"--y-grows", with([](auto& o) { o.read.up = "down"; }), true, true, false},
      {"--palate", with([](auto& o) { o.palate = "palate"; }), true, true, false},
  };
}

TEST(UnusedOptions, EachIsTakenWhereItAppliesAndRefusedByNameElsewhere) {
  for (const Case& c : cases())
    for (const auto& [format, registered, applies] :
         {std::tuple{curves, false, c.for_curves}, std::tuple{sensors, false, c.for_sensors},
          std::tuple{own, true, c.for_own}}) {
      const std::string said = refusal(c.options, format, registered);
      if (applies) EXPECT_EQ(said, "none") << format.name;
      else
        EXPECT_EQ(said.find(std::string(c.option) + ": does not apply"), 0u)
            << c.option << " " << format.name << ": " << said;
    }
}

TEST(UnusedOptions, OptionsThatContradictEachOtherAreRefused) {
  EXPECT_NE(refusal(with([](auto& o) { o.palate = "p", o.registered = true; }), curves, false)
                .find("--registered says"),
            std::string::npos);
  EXPECT_NE(refusal(with([](auto& o) { o.palate_sensor = "7"; }), sensors, false).find("--palate"),
            std::string::npos);
  EXPECT_NE(
      refusal(with([](auto& o) { o.read.mm_per_px = 0.2, o.read.units = "mm"; }), curves, false)
          .find("--units says mm"),
      std::string::npos);
}

TEST(UnusedOptions, ANoiseIsRefusedOnlyWhereEveryPointHasItsOwn) {
  MeasuredOptions o;
  o.noise_mm = 1;
  std::vector<ContourFrame> frames(1);
  frames[0].points = {{Vec3::Zero(), 1e-3, "curve"}, {Vec3::Zero(), 0, "curve"}};
  EXPECT_NO_THROW(refuse_unused_noise(o, frames));
  frames[0].points[1].sigma = 1e-3;
  EXPECT_THROW(refuse_unused_noise(o, frames), InputError);
}

}  // namespace
}  // namespace genio
