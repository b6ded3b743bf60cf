// The same for sensors and scans.

#include "forward/geometry/triangle_surface.hpp"
#include "tests/forward/small_model.hpp"
#include "tests/inverse/recording/formats/formats_fixture.hpp"

namespace genio {
namespace {

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
  EXPECT_EQ(f.format.name, "ag50x");
  o.sensors = {{"9", "tip"}};
  EXPECT_NE(error(path, o).find("9=tip"), std::string::npos);
}

TEST_F(Formats, WholeSamplesOfAPosFileCutShortAreReadAndTheRestIsSaid) {
  ReadOptions o;
  o.sensors = {{"5", "tip"}, {"4", "dorsum"}};
  const auto f = read_contours(write("short.pos", ema_bytes(12) + "xyz"), o);
  EXPECT_EQ(f.frames.size(), 3u);
  EXPECT_TRUE(says(f, "cut short: 3 whole samples are read; the last 3 bytes"));
  EXPECT_NE(error(write("none.pos", "x"), o).find("1 bytes of samples"), std::string::npos);
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

TEST_F(Formats, OneRowOfAg501TextWithAFieldTooManyIsNamed) {
  const std::string header = "Ch1_X\tCh1_Y\tCh1_Z\tCh1_phi\tCh1_theta\tCh1_RMS\tCh1_Extra\n";
  const std::string row = "10\t1\t-3\t0\t0\t4\t0";
  ReadOptions o;
  o.sensors = {{"1", "tip"}};
  EXPECT_EQ(
      read_raw(write("r.txt", header + "1\t" + row + "\n2\t" + row + "\n"), o).file.frames.size(),
      2u);
  for (const std::string& text :
       {row + "\n" + row + "\t5\n" + row + "\n", row + "\t5\n" + row + "\n" + row + "\n"})
    EXPECT_THROW(read_raw(write("e.txt", header + text), o), InputError);
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
  EXPECT_TRUE(says(read_contours(write("e.ssff", text + "zz"), o), "the last 2 bytes"));
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
