// Options of how a file is read that do not apply are refused by name.

#include "runs/frames/unused_options.hpp"

#include <gtest/gtest.h>

#include "runs/frames/column_options.hpp"

namespace genio {
namespace {

const FormatTraits curves{.name = "aaa", .splines = true},
    sensors{.name = "ema", .content = Content::sensors}, own{.name = "csv"},
    table{.name = "table", .columns = true};

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
  bool for_curves, for_sensors, for_own, for_table;
};

std::vector<Case> cases() {
  return {
      {"none", with([](auto&) {}), true, true, true, true},
      {"--sensors", with([](auto& o) { o.sensors = {"3=tip"}; }), false, true, false, false},
      {"--rate-hz", with([](auto& o) { o.read.rate_hz = 200; }), false, true, false, false},
      {"--units", with([](auto& o) { o.read.units = "cm"; }), true, true, false, true},
      {"--mm-per-px", with([](auto& o) { o.read.mm_per_px = 0.2; }), true, true, false, true},
      {"--facing", with([](auto& o) { o.read.facing = "left"; }), true, true, false, true},
      {"--y-grows", with([](auto& o) { o.read.up = "down"; }), true, true, false, true},
      {"--palate", with([](auto& o) { o.palate = "palate"; }), true, true, false, true},
      {"--columns", with([](auto& o) { o.columns = {"x=1"}; }), false, false, false, true},
      {"--spline", with([](auto& o) { o.read.spline = "Tongue"; }), true, false, false, false},
  };
}

TEST(UnusedOptions, EachIsTakenWhereItAppliesAndRefusedByNameElsewhere) {
  for (const Case& c : cases())
    for (const auto& [format, registered, applies] :
         {std::tuple{curves, false, c.for_curves}, std::tuple{sensors, false, c.for_sensors},
          std::tuple{own, true, c.for_own}, std::tuple{table, false, c.for_table}}) {
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

TEST(ColumnOptions, TheySayWhichColumnIsWhat) {
  const auto columns = parsed_columns({"x=tongue x", "y=4", "time=t=s"});
  EXPECT_EQ(columns.at("x"), "tongue x");
  EXPECT_EQ(columns.at("y"), "4");
  EXPECT_EQ(columns.at("time"), "t=s");
  EXPECT_TRUE(parsed_columns({}).empty());
}

TEST(ColumnOptions, WhatIsUnknownMissingOrSaidTwiceIsNamed) {
  for (const std::vector<std::string>& columns : {std::vector<std::string>{"x"},
                                                  {"=3"},
                                                  {"x="},
                                                  {"x=1"},
                                                  {"x=1", "x=2", "y=3"},
                                                  {"x=1", "y=2", "framme=3"}})
    EXPECT_THROW(parsed_columns(columns), InputError) << columns.front();
}

}  // namespace
}  // namespace genio
