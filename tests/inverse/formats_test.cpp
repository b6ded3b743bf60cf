// Every format gives back the contour that was written in it, and says what it took for granted.

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <set>

#include "forward/geometry/triangle_surface.hpp"
#include "forward/model/build_model.hpp"
#include "inverse/recording/contour_file.hpp"
#include "inverse/recording/formats/format_list.hpp"
#include "inverse/recording/frame_target.hpp"
#include "tests/forward/small_model.hpp"

namespace genio {
namespace {

namespace fs = std::filesystem;

class Formats : public testing::Test {
 protected:
  Formats() {
    for (int k = 0; k < 30; ++k) {  // tip first, an arch 70 mm long
      const double s = k / 29.0;
      line.emplace_back(55 + 70 * s, 95 + 25 * std::sin(3 * s));
    }
  }
  ~Formats() override { fs::remove_all(folder); }

  std::string write(const std::string& name, const std::string& text) {
    fs::create_directories(folder);
    std::ofstream(folder / name, std::ios::binary) << text;
    return (folder / name).string();
  }
  /// The line as two frames, the second 1 mm up.
  void expect_line(const ContourFile& f, double tolerance = 0.01) {
    ASSERT_EQ(f.frames.size(), 2u);
    for (size_t k = 0; k < 2; ++k) {
      ASSERT_EQ(f.frames[k].points.size(), line.size());
      for (size_t i = 0; i < line.size(); ++i) {
        EXPECT_NEAR(1e3 * f.frames[k].points[i].position[0], line[i][0], tolerance);
        EXPECT_NEAR(1e3 * f.frames[k].points[i].position[2], line[i][1] + double(k), tolerance);
      }
    }
  }
  std::string error(const std::string& path, const ReadOptions& o = {}) {
    try {
      read_contours(path, o);
    } catch (const InputError& e) {
      return e.what();
    }
    return "";
  }
  static bool says(const ContourFile& f, const std::string& what) {
    for (const auto& r : f.remarks)
      if (r.find(what) != std::string::npos) return true;
    return false;
  }
  const fs::path folder = fs::temp_directory_path() / fmt::format("genio_formats_{}", getpid());
  std::vector<Vec2> line;  // [mm], model axes
};

TEST_F(Formats, GetContoursLongInPixelsLookingRight) {
  std::string text = "FRAME\tTIME\tNOTE\tPOINT\tX\tY\n";
  for (int k = 0; k < 2; ++k)
    for (size_t i = 0; i < line.size(); ++i)
      text += fmt::format("{}\t{}\tword\t{}\t{:.4f}\t{:.4f}\n", 12 + k, 0.01 * k, i + 1,
                          (0 - line[i][0]) / 0.2, (0 - line[i][1] - k) / 0.2);
  const auto path = write("a.tsv", text);
  ReadOptions o;
  EXPECT_NE(error(path).find("--mm-per-px"), std::string::npos);
  o.mm_per_px = 0.2;
  EXPECT_FALSE(read_contours(path, o).facing_known);
  o.facing = "right";
  const auto f = read_contours(path, o);
  expect_line(f);
  EXPECT_EQ(f.frames[0].number, 12);
  EXPECT_EQ(f.frames[0].label, "word");
  EXPECT_DOUBLE_EQ(f.frames[1].time_s, 0.01);
  EXPECT_FALSE(f.model_frame);
}

TEST_F(Formats, GetContoursWideInMillimetres) {
  std::string text = "FRAME\tTIME\tNOTE";
  for (size_t i = 1; i <= line.size(); ++i) text += fmt::format("\tmmX{:03d}\tmmY{:03d}", i, i);
  for (int k = 0; k < 2; ++k) {
    text += fmt::format("\n{}\t0\t", k + 1);
    for (const Vec2& q : line) text += fmt::format("\t{:.4f}\t{:.4f}", q[0], q[1] + k);
  }
  ReadOptions o;
  o.facing = "left";
  const auto f = read_contours(write("w.tsv", text + "\n"), o);
  expect_line(f);
  EXPECT_TRUE(says(f, "units mm"));
  EXPECT_TRUE(says(f, "y grows up (by the arch)"));
}

TEST_F(Formats, EdgeTrakConWithBlanksAndAnEmptyLastField) {
  std::string text;
  for (const Vec2& q : line)  // y down
    text +=
        fmt::format("\t{:.3f}\t{:.3f}\t{:.3f}\t{:.3f}\t\n", q[0], 300 - q[1], q[0], 300 - q[1] - 1);
  ReadOptions o;
  o.facing = "left";
  auto f = read_contours(write("a.con", text), o);
  EXPECT_TRUE(says(f, "y grows down (by the arch)"));
  for (auto& frame : f.frames)
    for (auto& p : frame.points) p.position[2] += 0.3;
  expect_line(f);
}

TEST_F(Formats, GetContoursTableForEdgeTrak) {
  std::string text = "FRAME7\t\tFRAME9\t\nX\tY\tX\tY\n";
  for (const Vec2& q : line)
    text += fmt::format("{:.3f}\t{:.3f}\t{:.3f}\t{:.3f}\n", q[0], q[1], q[0], q[1] + 1);
  ReadOptions o;
  o.facing = "left";
  const auto f = read_contours(write("b_EdgeTrak.tsv", text), o);
  expect_line(f);
  EXPECT_EQ(f.frames[1].number, 9);
}

TEST_F(Formats, PlainWideCsv) {
  std::string text;
  for (const Vec2& q : line)
    text += fmt::format("{:.4f},{:.4f},{:.4f},{:.4f}\n", 0.1 * q[0], 0.1 * q[1], 0.1 * q[0],
                        0.1 * (q[1] + 1));
  ReadOptions o;
  o.facing = "left";
  const auto f = read_contours(write("p.csv", text), o);
  expect_line(f);
  EXPECT_TRUE(says(f, "units cm (by their extent)"));
  EXPECT_TRUE(says(f, "from tip to root"));
}

TEST_F(Formats, AaaPolarBlocks) {
  std::string text =
      "Prompt\tTime of sample in recording\tNumber of points of spline \"Tongue\"\t"
      "R mm values\tAngle values\n";
  for (int k = 0; k < 2; ++k) {
    std::string radii, angles;
    for (const Vec2& q : line) {
      const double x = -q[0], y = q[1] + k;  // to the front
      radii += fmt::format("\t{:.6f}", std::hypot(x, y));
      angles += fmt::format("\t{:.8f}", std::atan2(x, y));
    }
    text += fmt::format("word\t{}\t{}{}{}\n", 0.5 + k, line.size(), radii, angles);
  }
  const auto f = read_contours(write("polar.tsv", text));
  expect_line(f);
  EXPECT_EQ(f.frames[0].label, "word");
  EXPECT_DOUBLE_EQ(f.frames[1].time_s, 1.5);
  EXPECT_TRUE(f.facing_known);
}

/// Two channels of seven floats a sample.
std::string ema_bytes(int channels) {
  std::string bytes;
  for (int s = 0; s < 3; ++s)
    for (int c = 0; c < channels; ++c)
      for (int i = 0; i < 7; ++i) {
        const float v = c == 1 ? 0 : float(i == 0 ? 10 * c + s : i == 2 ? 5 + s : i);
        bytes.append(reinterpret_cast<const char*>(&v), 4);
      }
  return bytes;
}

TEST_F(Formats, EmaAg501Pos) {
  std::string header = "AG50xDATA_V003\n00000070\nNumberOfChannels=4\nSamplingFrequencyHz=250\n";
  header += std::string("\0\x1a", 2);
  header.resize(70, '\0');
  const auto path = write("a.pos", header + ema_bytes(4));
  EXPECT_NE(error(path).find("--sensors"), std::string::npos);
  EXPECT_NE(error(path).find("2: never on"), std::string::npos);
  ReadOptions o;
  o.sensors = {{"4", "tip"}, {"3", "dorsum"}, {"2", "blade"}};
  const auto f = read_contours(path, o);
  ASSERT_EQ(f.frames.size(), 3u);
  EXPECT_DOUBLE_EQ(f.frames[2].time_s, 2 / 250.0);
  ASSERT_EQ(f.frames[0].points.size(), 2u);  // channel 2 is off
  for (const auto& p : f.frames[1].points) {
    EXPECT_NEAR(1e3 * p.position[0], p.kind == "tip" ? -31 : -21, 1e-4);  // the tip is in front
    EXPECT_NEAR(1e3 * p.position[2], 6, 1e-4);
    EXPECT_TRUE(std::isnan(p.position[1]));
  }
  EXPECT_TRUE(says(f, "face looks right (the tip is there)"));
  EXPECT_EQ(f.format.name, "ema");
  o.sensors = {{"9", "tip"}};
  EXPECT_NE(error(path, o).find("9=tip"), std::string::npos);
  write("short.pos", header + ema_bytes(4) + "x");
  EXPECT_NE(error((folder / "short.pos").string()).find("multiple of 112"), std::string::npos);
}

TEST_F(Formats, EmaAg500PosHasNoHeader) {
  ReadOptions o;
  o.sensors = {{"5", "tip"}};
  const auto f = read_contours(write("b.pos", ema_bytes(12)), o);
  ASSERT_EQ(f.frames.size(), 3u);
  EXPECT_DOUBLE_EQ(f.frames[1].time_s, 0.005);
  EXPECT_NEAR(1e3 * f.frames[0].points[0].position[0], -40, 1e-4);
}

TEST_F(Formats, EmaText) {
  std::string text = "Ch1_X\tCh1_Y\tCh1_Z\tCh1_phi\tCh1_theta\tCh1_RMS\tCh1_Extra\n";
  text += "12.5\t1\t-3.25\t0\t0\t0\t0\n13.5\t1\t-4.25\t0\t0\t0\t0\n";
  ReadOptions o;
  o.sensors = {{"1", "tip"}}, o.rate_hz = 250;
  const auto f = read_contours(write("c.txt", text), o);
  ASSERT_EQ(f.frames.size(), 2u);
  EXPECT_NEAR(1e3 * f.frames[1].points[0].position[0], -13.5, 1e-9);
  EXPECT_DOUBLE_EQ(f.frames[1].time_s, 0.004);
}

TEST_F(Formats, EmaSsff) {
  std::string text =
      "SSFF -- (c) SHLRC\nMachine IBM-PC\nRecord_Freq 200.0\nStart_Time 0.0\nColumn tt FLOAT 2\n"
      "Column td_posy FLOAT 1\nColumn td_posz FLOAT 1\n-----------------\n";
  for (int s = 0; s < 2; ++s)
    for (float v : {20.0f + s, 4.0f, -10.0f, 8.0f + s})
      text.append(reinterpret_cast<const char*>(&v), 4);
  ReadOptions o;
  o.sensors = {{"tt", "tip"}, {"td", "dorsum"}};
  const auto f = read_contours(write("d.ssff", text), o);
  ASSERT_EQ(f.frames.size(), 2u);
  for (const auto& p : f.frames[1].points) {
    EXPECT_NEAR(1e3 * p.position[0], p.kind == "tip" ? -21 : 10, 1e-5);
    EXPECT_NEAR(1e3 * p.position[2], p.kind == "tip" ? 4 : 9, 1e-5);
  }
  EXPECT_NE(error(write("e.ssff", text + "zz"), o).find("multiple of 16"), std::string::npos);
}

TEST_F(Formats, ScansInMillimetresAndMetres) {
  for (const double unit : {1.0, 1e-3}) {
    TriangleSurface s;
    for (const Vec2& q : line)
      for (double y : {-10.0, 10.0}) s.vertices.push_back(unit * Vec3(q[0], y, q[1]));
    for (int k = 0; k + 3 < int(s.vertices.size()); k += 2) {
      s.triangles.push_back({k, k + 1, k + 2});
      s.triangles.push_back({k + 1, k + 3, k + 2});
    }
    const auto path = write("s.obj", "");
    write_obj(path, s);
    const auto f = read_contours(path);
    ASSERT_EQ(f.frames.size(), 1u);
    ASSERT_EQ(f.frames[0].points.size(), 60u);
    EXPECT_EQ(f.frames[0].points[0].kind, "surface");
    EXPECT_TRUE(says(f, unit == 1 ? "units mm" : "units m "));
    double low = 1;
    for (const auto& p : f.frames[0].points) low = std::min(low, p.position[0]);
    EXPECT_NEAR(low, 0.055, 1e-6);
  }
}

TEST_F(Formats, EveryFormatReadsItsOwnExampleAndKnowsIt) {
  std::set<std::string> names;
  for (const ContourFormat& format : contour_formats()) {
    SCOPED_TRACE(format.traits.name);
    EXPECT_TRUE(names.insert(format.traits.name).second);
    EXPECT_FALSE(format.about.empty());
    EXPECT_GT(format.traits.noise, 0);
    const auto path = write(format.example.name, format.example.text);
    EXPECT_EQ(&format_of(path), &format);
    EXPECT_EQ(&format_named(format.traits.name), &format);
    EXPECT_NE(format_choices().find(format.traits.name), std::string::npos);
    const auto found = read_contours(path, format.example.options);
    EXPECT_EQ(found.format.name, format.traits.name);
    EXPECT_EQ(found.format.content, format.traits.content);
    ASSERT_FALSE(found.frames.empty());
    EXPECT_FALSE(found.frames.front().points.empty());
    ReadOptions named = format.example.options;
    named.format = format.traits.name;
    EXPECT_EQ(read_contours(path, named).remarks, found.remarks);
  }
}

TEST_F(Formats, AnUnknownNameSuggestsTheNearest) {
  ReadOptions o;
  o.format = "egdetrak";
  const std::string said = error(write("p.csv", "1,2\n"), o);
  EXPECT_NE(said.find("--format egdetrak: unknown; did you mean edgetrak?"), std::string::npos);
  EXPECT_NE(said.find("or csv"), std::string::npos);
}

TEST_F(Formats, AFileThatNoFormatKnowsIsAskedAbout) {
  EXPECT_NE(error(write("x.txt", "\nwords\n")).find("x.txt:2: neither tab-separated"),
            std::string::npos);
  EXPECT_NE(error((folder / "absent.txt").string()).find("no such file"), std::string::npos);
}

TEST_F(Formats, AFileOfNobodysSizeIsAskedAbout) {
  std::string text;
  for (const Vec2& q : line) text += fmt::format("{},{}\n", 9 * q[0], 9 * q[1]);
  EXPECT_NE(error(write("px.csv", text)).find("--units"), std::string::npos);
  ReadOptions o;
  o.units = "furlong";
  EXPECT_NE(error(write("px.csv", text), o).find("expected mm, cm, m, um or px"),
            std::string::npos);
}

TEST_F(Formats, ThePalateTellsWhichWayTheFaceLooks) {
  const Model m = read_model(test::generic_model());
  const auto cut = midsagittal_cut(*m.palate).front();
  std::string palate = "frame,point,x_mm,z_mm\n";
  for (size_t k = cut.size() / 5; k < cut.size() - cut.size() / 5; ++k)
    palate += fmt::format("1,{},{:.4f},{:.4f}\n", k, 1e3 * cut[k][0], 1e3 * cut[k][1]);
  const auto palate_path = write("palate.csv", palate);
  std::string text;
  for (const Vec2& q : TongueLine(m).sample(m.rest, 30))
    text += fmt::format("{:.4f},{:.4f}\n", 1e3 * q[0], 1e3 * q[1]);
  ContourFile file = read_contours(write("t.csv", text));
  EXPECT_FALSE(file.facing_known);
  const auto r = register_file(m, file, palate_path);
  EXPECT_TRUE(says(r.file, "face looks left"));
  EXPECT_LT(r.registration.palate_rms, 1e-3);
}

TEST_F(Formats, RealAg500SampleIsRead) {
  const std::string data = test::reference_folder();
  if (data.empty()) GTEST_SKIP() << "the reference data are not here";
  ReadOptions o;
  o.sensors = {{"5", "tip"}, {"4", "blade"}, {"3", "dorsum"}};
  const auto f = read_contours(data + "/ema_ag500/0025.pos", o);
  ASSERT_EQ(f.frames.size(), 20u);
  // Its ears lie left and right along x: y runs along the head, backwards.
  EXPECT_TRUE(says(f, "the second axis runs along the head"));
  EXPECT_TRUE(says(f, "face looks left"));
  for (const auto& frame : f.frames) {
    ASSERT_EQ(frame.points.size(), 3u);
    EXPECT_NEAR(1e3 * frame.points[0].position[0], 49.8, 1);
    EXPECT_NEAR(1e3 * frame.points[2].position[0], 15.4, 1);
  }
}

}  // namespace
}  // namespace genio
