#include "inverse/recording/session/scan_session.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <random>

#include "forward/model/build_model.hpp"
#include "forward/statics/equilibrium.hpp"
#include "tests/forward/small_model.hpp"

namespace genio {
namespace {

/// The frame of a scanner that stands as it likes.
struct Elsewhere {
  Mat3 turn = (Eigen::AngleAxisd(1.9, Vec3::UnitX()) * Eigen::AngleAxisd(2.2, Vec3::UnitZ()))
                  .toRotationMatrix();
  double size = 1.06;
  Vec3 operator()(const Vec3& q) const { return size * (turn * q) + Vec3(0.03, -0.05, 0.02); }
  Vec3 back(const Vec3& q) const { return turn.transpose() * (q - Vec3(0.03, -0.05, 0.02)) / size; }
};

SessionFile scan_of(const std::vector<Vec3>& points, const Elsewhere& away) {
  SessionFile file{"scan.ply", {}, {}};
  file.file.format.content = Content::surface;
  ContourFrame& frame = file.file.frames.emplace_back();
  std::mt19937 random(1);
  std::normal_distribution<double> noise(0, 3e-4);
  for (const Vec3& q : points)
    frame.points.push_back(
        {away(q) + Vec3(noise(random), noise(random), noise(random)), 0, "surface"});
  return file;
}

/// The upper half of the tongue's surface where muscles pull, as a scanner sees it.
std::vector<Vec3> pulled_surface(const Model& m) {
  Workspace ws(m);
  Parameters p = default_parameters(m);
  set_command(m, "GGP", 3, p);
  set_command(m, "TRANS", 1, p);
  const Positions x = solve_equilibrium(m, p, m.rest, ws).x;
  std::vector<Vec3> all, upper;
  Vec3 middle = Vec3::Zero();
  for (const Facet& f : facets(m.surface)) {
    const auto corners = corners_of(f, x);
    all.push_back((corners[0] + corners[1] + corners[2]) / 3);
    middle += all.back();
  }
  for (const Vec3& q : all)
    if (q[2] > middle[2] / double(all.size())) upper.push_back(q);
  return upper;
}

double rms_off(const AlignedScan& a, const SessionFile& scan, const Elsewhere& away) {
  double sum = 0;
  const auto there = surface_points(a.file), here = surface_points(scan.file);
  for (size_t k = 0; k < here.size(); ++k)
    sum += (there[k] - away.back(here[k])).squaredNorm() / double(here.size());
  return std::sqrt(sum);
}

TEST(ScanSession, AScanInAnyFrameComesBackByItsShape) {
  const Model m = read_model(test::generic_model());
  const Elsewhere away;
  const SessionFile scan = scan_of(pulled_surface(m), away);
  const AlignedScan a = align_scan(m, scan, {}, {});
  EXPECT_TRUE(a.judgement.faults.empty());
  EXPECT_LT(rms_off(a, scan, away), 4e-3);
  EXPECT_NEAR(a.registration.pose.scale, 1 / away.size, 0.06);
  EXPECT_LT(a.registration.off_reach, 1.5e-3);
}

TEST(ScanSession, ThePalatesSurfaceTellsMore) {
  const Model m = read_model(test::generic_model());
  const Elsewhere away;
  const SessionFile scan = scan_of(pulled_surface(m), away);
  const AlignedScan alone = align_scan(m, scan, {}, {});
  const AlignedScan a = align_scan(m, scan, scan_of(m.palate->vertices, away), {});
  EXPECT_TRUE(a.judgement.faults.empty());
  EXPECT_LT(rms_off(a, scan, away), 1.5e-3);
  EXPECT_LT(a.registration.palate_rms, 1e-3);
  EXPECT_LT(a.registration.tilt_sd, alone.registration.tilt_sd);
}

ReadOptions with_axes(const char* axes) {
  ReadOptions options;
  options.axes = axes;
  return options;
}

TEST(ScanSession, AxesThatAreSaidAreTheOnlyOnesTried) {
  const Model m = read_model(test::generic_model());
  Elsewhere away;
  away.turn = Mat3::Identity();
  const SessionFile scan = scan_of(pulled_surface(m), away);
  EXPECT_EQ(align_scan(m, scan, {}, with_axes("+x+z")).reading, parse_axes("+x+z"));
  EXPECT_THROW(align_scan(m, scan, {}, with_axes("up")), InputError);
}

TEST(ScanSession, WhatIsNoTongueFails) {
  const Model m = read_model(test::generic_model());
  std::vector<Vec3> plate;
  for (int i = 0; i < 20; ++i)
    for (int j = 0; j < 20; ++j) plate.emplace_back(5e-3 * i, 5e-3 * j, 0);
  EXPECT_FALSE(align_scan(m, scan_of(plate, {}), {}, {}).judgement.faults.empty());
}

TEST(ScanSession, ATraceIsNoPalateOfAScan) {
  const Model m = read_model(test::generic_model());
  const SessionFile scan = scan_of(pulled_surface(m), {});
  SessionFile trace = scan_of(m.palate->vertices, {});
  trace.file.format.content = Content::curves;
  EXPECT_THROW(align_scan(m, scan, trace, {}), InputError);
}

TEST(ScanSession, AScanElsewhereIsNotInTheModelsFrame) {
  const Model m = read_model(test::generic_model());
  std::vector<Vec3> points = pulled_surface(m);
  EXPECT_TRUE(judge_scan(m, points, {}, false).faults.empty());
  for (Vec3& q : points) q[0] += 0.04;
  EXPECT_FALSE(judge_scan(m, points, {}, false).faults.empty());
}

}  // namespace
}  // namespace genio
