// Modes of outlines: what they keep of the speakers, and what is told of a speaker by a part of
// him.

#include "speaker/modes/outline_modes.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <numbers>
#include <random>

#include "speaker/modes/anatomy_estimate.hpp"
#include "speaker/modes/modes_file.hpp"
#include "speaker/modes/speaker_sight.hpp"

namespace genio {
namespace {

/// A head in the form of arcs: `size` of all lengths, `depth` of the pharynx beside.
OutlinePoints drawn_head(double size, double arch, double depth) {
  OutlinePoints p{std::vector<Vec2>(size_t(outline_point_count())),
                  std::vector<bool>(size_t(outline_point_count()), true)};
  const auto fill = [&](const char* name, auto at) {
    const OutlineStretch& s = outline_stretch(name);
    for (int k = 0; k < s.count; ++k)
      p.places[size_t(s.first + k)] = size * at(double(k) / std::max(1, s.count - 1));
  };
  constexpr double pi = std::numbers::pi;
  fill("floor",
       [&](double t) { return Vec2(0.06 - 0.04 * t + depth * (1 - t), -0.03 + 0.004 * t); });
  fill("mandible", [&](double t) { return Vec2(0.02 - 0.003 * t, -0.026 + 0.015 * t); });
  fill("mouth_floor",
       [&](double t) { return Vec2(0.017 - 0.012 * t, -0.01 + 0.012 * std::sin(t)); });
  fill("surface", [&](double t) {
    return Vec2(0.04 - 0.035 * std::cos(pi * t) + depth * t * t,
                0.002 + 0.026 * std::sin(pi * t) - 0.03 * t * t);
  });
  fill("palate",
       [&](double t) { return Vec2(0.06 * t, 0.012 + (0.02 + arch) * std::sin(0.8 * pi * t)); });
  fill("hyoid", [&](double) { return Vec2(0.064 + depth, -0.032); });
  fill("pharynx", [&](double t) { return Vec2(0.09 + depth, -0.03 + 0.06 * t); });
  return p;
}

struct Head {
  double size, arch, depth;
};

std::vector<Head> drawn_heads(int count, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  std::vector<Head> heads;
  for (int k = 0; k < count; ++k)
    heads.push_back({1 + 0.06 * normal(random), 2e-3 * normal(random), 3e-3 * normal(random)});
  return heads;
}

/// Such heads somewhere, as their measurements have them, each point off by 0.2 mm.
std::vector<OutlinePoints> measured_heads(const std::vector<Head>& heads, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  std::vector<OutlinePoints> all;
  for (const Head& h : heads) {
    OutlinePoints p = drawn_head(h.size, h.arch, h.depth);
    const Eigen::Rotation2Dd turn(0.2 * normal(random));
    const Vec2 shift(0.05 * normal(random), 0.05 * normal(random));
    for (Vec2& q : p.places) q = turn * (q + 2e-4 * Vec2(normal(random), normal(random))) + shift;
    all.push_back(p);
  }
  return all;
}

TEST(OutlineModes, TellWhereSpeakersLieNothingAndKeepTheirVariance) {
  const auto heads = measured_heads(drawn_heads(30, 1), 2);
  const OutlineModes modes = modes_of_outlines(heads);
  EXPECT_EQ(modes.names,
            (std::vector<std::string>{"size", "palate_height", "pharynx_length", "jaw_height",
                                      "tongue_length", "pharynx_depth", "shape1", "shape2"}));
  // Measures tell up from back as the first speaker stands; where the others were is chance.
  auto moved = heads;
  for (size_t k = 1; k < moved.size(); ++k)
    for (Vec2& q : moved[k].places)
      q = Eigen::Rotation2Dd(k % 2 ? 0.4 : -0.2) * q + Vec2(0.1, -0.02 * double(k));
  const OutlineModes same = modes_of_outlines(moved);
  for (Eigen::Index k = 0; k < modes.named(); ++k)
    EXPECT_NEAR(same.modes.col(k).norm(), modes.modes.col(k).norm(),
                0.02 * modes.modes.col(0).norm());
  EXPECT_GT(modes.kept, 0.5);
  EXPECT_LE(modes.kept, 1);
  // Three things vary and noise of 0.2 mm: three modes hold nearly all of it.
  EXPECT_GT(modes.modes.leftCols(6).squaredNorm(), 0.95 * modes.modes.squaredNorm());
}

TEST(OutlineModes, ComeBackFromTheirFile) {
  const OutlineModes modes = modes_of_outlines(measured_heads(drawn_heads(20, 3), 4));
  const std::string path = (std::filesystem::temp_directory_path() / "outline_modes.csv").string();
  write_outline_modes(modes, "drawn heads", path);
  const OutlineModes back = read_outline_modes(path);
  EXPECT_EQ(back.names, modes.names);
  EXPECT_EQ(back.speakers, modes.speakers);
  EXPECT_LT((back.mean - modes.mean).cwiseAbs().maxCoeff(), 1e-6);
  EXPECT_LT((back.modes - modes.modes).cwiseAbs().maxCoeff(), 1e-7);
  EXPECT_LT((back.apart - modes.apart).cwiseAbs().maxCoeff(), 1e-6);
  EXPECT_NEAR(back.kept, modes.kept, 1e-6);
}

TEST(OutlineModes, AFileThatIsCutIsRefusedByName) {
  const std::string path = (std::filesystem::temp_directory_path() / "cut_modes.csv").string();
  std::ofstream(path) << "# kept 0.8, speakers 12\n"
                      << "stretch,point,x_mm,z_mm,apart_x_mm,apart_z_mm,size_x_mm,size_z_mm\n"
                      << "floor,0,1,2,0.1,0.1,1,one\n";
  try {
    read_outline_modes(path);
    FAIL() << "it was read";
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("cut_modes.csv: line 3: column size"), std::string::npos)
        << e.what();
  }
}

class SightOfASpeaker : public testing::Test {
 protected:
  static SpeakerSight of(const OutlinePoints& p, std::mt19937& random) {
    std::normal_distribution<double> noise(0, 5e-4);
    SpeakerSight sight;
    sight.lines = {{{}, true, 5e-4}, {{}, false, 5e-4}};
    for (int i : points_in_sight())
      sight.lines[i < outline_stretch("palate").first ? 1 : 0].points.push_back(
          p.places[size_t(i)] + Vec2(noise(random), noise(random)));
    return sight;
  }
  /// What ten heads' estimates say of places that nobody saw.
  struct HiddenPart {
    double held = 0;  ///< share of coordinates within their 90 % intervals
    double off = 0,
           usual = 0;  ///< root mean squares of errors, and of what they are said to be [m]
    double fit = 0;    ///< the worst fit [m]
  };
  static HiddenPart hidden_part(const std::function<void(SpeakerSight&)>& change) {
    const auto heads = measured_heads(drawn_heads(41, 5), 6);
    const OutlineModes modes = modes_of_outlines({heads.begin(), heads.begin() + 31});
    std::mt19937 random(7);
    HiddenPart part;
    int counted = 0;
    for (size_t k = 31; k < heads.size(); ++k) {
      SpeakerSight sight = of(heads[k], random);
      change(sight);
      const AnatomyEstimate e = estimate_anatomy(modes, sight);
      part.fit = std::max(part.fit, e.rms);
      for (const char* name : {"floor", "mandible", "hyoid"}) {
        const OutlineStretch& s = outline_stretch(name);
        for (int i = s.first; i < s.first + s.count; ++i)
          for (int axis = 0; axis < 2; ++axis) {
            const double d = e.places[size_t(i)][axis] - heads[k].places[size_t(i)][axis];
            part.held += std::abs(d) < 1.645 * e.sd[2 * i + axis], ++counted;
            part.off += d * d, part.usual += std::pow(e.sd[2 * i + axis], 2);
          }
      }
    }
    part.held /= counted;
    part.off = std::sqrt(part.off / counted), part.usual = std::sqrt(part.usual / counted);
    return part;
  }
};

TEST_F(SightOfASpeaker, TellsTheHiddenPartWithinItsInterval) {
  const HiddenPart hidden = hidden_part([](SpeakerSight&) {});
  EXPECT_LT(hidden.fit, 1.5e-3);
  EXPECT_GT(hidden.held, 0.8);
  EXPECT_LT(hidden.off, 3e-3);
  EXPECT_GT(hidden.off, 0.3 * hidden.usual);  // nor far too wide
}

TEST_F(SightOfASpeaker, TellsItAlsoByATraceThatGoesOnAlongTheVelum) {
  const HiddenPart hidden = hidden_part([](SpeakerSight& sight) {
    std::vector<Vec2>& trace = sight.lines[0].points;
    const Vec2 on = (trace.back() - trace[trace.size() - 4]) / 3;
    for (int k = 0; k < 8; ++k) trace.push_back(trace.back() + on);
  });
  EXPECT_GT(hidden.held, 0.8);
  EXPECT_LT(hidden.off, 3e-3);
}

TEST_F(SightOfASpeaker, FollowsWhereverTheHeadWas) {
  const auto heads = measured_heads(drawn_heads(32, 8), 9);
  const OutlineModes modes = modes_of_outlines({heads.begin(), heads.begin() + 31});
  std::mt19937 random(10);
  const SpeakerSight sight = of(heads[31], random);
  const AnatomyEstimate here = estimate_anatomy(modes, sight);
  const auto off_after = [&](const Similarity& away) {
    SpeakerSight moved = sight;
    for (SightedLine& line : moved.lines)
      for (Vec2& q : line.points) q = away(q);
    const AnatomyEstimate there = estimate_anatomy(modes, moved);
    double farthest = 0;
    for (size_t i = 0; i < here.places.size(); ++i)
      farthest = std::max(farthest, (away(here.places[i]) - there.places[i]).norm());
    return farthest;
  };
  EXPECT_LT(off_after({1, 0, Vec2(0.3, -0.1)}), 1e-5);
  // A turn is believed to be less likely the larger it is, and these lines tell it to 10 degrees:
  // the estimate is drawn back by a ninth of it.
  EXPECT_LT(off_after({1, 0.15, Vec2(0.3, -0.1)}), 2e-3);
  EXPECT_LT(off_after({1, 0.03, Vec2(0.3, -0.1)}), 4e-4);
}

TEST_F(SightOfASpeaker, ItsOutlineHasThePalateAsItWasTraced) {
  const OutlinePoints head = drawn_head(1, 0, 0);
  AnatomyEstimate estimate;
  estimate.places = head.places;
  std::vector<Vec2> trace;  // from the rear to the front, 1 mm above the estimate
  const OutlineStretch& palate = outline_stretch("palate");
  for (int k = palate.count - 1; k > 7; --k)
    trace.push_back(head.places[size_t(palate.first + k)] + Vec2(0, 1e-3));
  SpeakerSight sight;
  sight.lines = {{trace, true, 5e-4}};
  const auto drawn = sighted_outline(estimate, sight, "contours.csv").segments.at(Segment::palate);
  ASSERT_GT(drawn.size(), trace.size());
  const size_t before = drawn.size() - trace.size();
  for (size_t k = 0; k < trace.size(); ++k)
    EXPECT_LT((drawn[before + k] - trace[trace.size() - 1 - k]).norm(), 1e-9);
  for (size_t k = 0; k < before; ++k) {
    EXPECT_LT((drawn[k] - head.places[size_t(palate.first) + k]).norm(), 1e-12);
    EXPECT_LT(drawn[k][0], trace.back()[0]);
  }
}

TEST_F(SightOfASpeaker, OfAPalateAloneIsRefused) {
  const OutlineModes modes = modes_of_outlines(measured_heads(drawn_heads(20, 3), 4));
  SpeakerSight sight;
  sight.lines = {{{Vec2(0, 0), Vec2(0.03, 0.01)}, true, 5e-4}};
  EXPECT_THROW(estimate_anatomy(modes, sight), InputError);
}

}  // namespace
}  // namespace genio
