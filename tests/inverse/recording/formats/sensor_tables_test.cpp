// Tables of sensors as devices, R and corpora write them.

#include <functional>

#include "tests/inverse/recording/formats/formats_fixture.hpp"

namespace genio {
namespace {

ReadOptions sensors(std::map<std::string, std::string> named) {
  ReadOptions o;
  o.sensors = std::move(named);
  return o;
}

TEST_F(Formats, TablesThatRWritesAreReadAndNaIsMissing) {
  const std::string header =
      "\"Ch1_X\" \"Ch1_Y\" \"Ch1_Z\" \"Ch1_phi\" \"Ch1_theta\" \"Ch1_RMS\" \"Ch1_Extra\" "
      "\"Ch2_X\" \"Ch2_Y\" \"Ch2_Z\" \"Ch2_phi\" \"Ch2_theta\" \"Ch2_RMS\" \"Ch2_Extra\"\n";
  const std::string row = "NA NA NA NA NA NA NA -101.5 0.3 91.25 10 20 3.1 0\n";
  for (const bool named_rows : {false, true}) {
    const auto f = read_contours(write("r.txt", header + (named_rows ? "\"1\" " : "") + row),
                                 sensors({{"1", "dorsum"}, {"2", "tip"}}));
    ASSERT_EQ(f.frames.size(), 1u);
    ASSERT_EQ(f.frames[0].points.size(), 1u);
    EXPECT_NEAR(std::abs(f.frames[0].points[0].position[0]), 0.1015, 1e-12);
    EXPECT_TRUE(says(f, "sensor 1 (dorsum) has no value"));
  }
}

TEST_F(Formats, DecimalCommasAreReadAndNeverMixedWithPoints) {
  const std::string header = "Ch1_X\tCh1_Y\tCh1_Z\tCh1_phi\tCh1_theta\tCh1_RMS\tCh1_Extra\n";
  const auto f = read_contours(write("c.txt", header + "-93,22\t0,3\t87,95\t0\t0\t3,1\t0\n"),
                               sensors({{"1", "tip"}}));
  EXPECT_NEAR(std::abs(f.frames[0].points[0].position[2]), 0.08795, 1e-12);
  EXPECT_NE(
      error(write("m.txt", header + "-93,22\t0.3\t87,95\t0\t0\t3,1\t0\n"), sensors({{"1", "tip"}}))
          .find("m.txt:2: '0.3': has a decimal point, and numbers before it have decimal commas"),
      std::string::npos);
  EXPECT_NE(
      error(write("w.txt", header + "-93,22\tword\t87,95\t0\t0\t3,1\t0\n"), sensors({{"1", "tip"}}))
          .find("w.txt:2: 'word' is not a finite number"),
      std::string::npos);
}

TEST_F(Formats, DecimalCommasBetweenCommasAreNamed) {
  const std::string header = "Ch1_X,Ch1_Y,Ch1_Z,Ch1_phi,Ch1_theta,Ch1_RMS,Ch1_Extra\n";
  const std::string row = "-93,22,0,3,87,95,0,0,3,1,0,0,0,0\n";
  EXPECT_NE(error(write("h.csv", header + row), sensors({{"1", "tip"}}))
                .find("h.csv:2: 14 fields; the header has 7. Decimal commas"),
            std::string::npos);
  EXPECT_NE(error(write("n.csv", row), sensors({{"1", "tip"}})).find("decimal commas"),
            std::string::npos);
}

TEST_F(Formats, FourteenChannelsWithoutAHeaderAreNoUltrasound) {
  std::string row;
  for (int c = 0; c < 14; ++c) row += fmt::format("{}\t1\t{}\t10\t20\t3\t0\t", -80 - c, 80 + c);
  row.back() = '\n';
  const auto path = write("98.txt", row);
  EXPECT_EQ(format_of(path).traits.name, "ag501-text");
  EXPECT_EQ(read_contours(path, sensors({{"1", "tip"}, {"14", "dorsum"}})).frames[0].points.size(),
            2u);
  ReadOptions named = sensors({{"1", "tip"}});
  named.format = "ema";
  EXPECT_EQ(read_contours(path, named).frames.size(), 1u);
}

TEST_F(Formats, NamedSensorsOfAFileWithoutAnyAreAnError) {
  EXPECT_NE(error(write("x.csv", "1,2\n3,4\n"), sensors({{"1", "tip"}})).find("no recording of"),
            std::string::npos);
}

TEST_F(Formats, NdiWaveSensorsInABadStateAreMissing) {
  const std::string header =
      "Wav Time\tA\tFrame\tState\tQ0\tQx\tQy\tQz\tTx\tTy\tTz\tB\tFrame\tState\tQ0\tQx\tQy\tQz\tTx\t"
      "Ty\tTz\n";
  const auto f = read_contours(
      write("n.tsv", header +
                         "0.01\t\t1\tOK\t1\t0\t0\t0\t20\t1\t5\t\t1\tBad Fit\t1\t0\t0\t0\t9\t9\t9"
                         "\n0.02\t\t2\tOK\t1\t0\t0\t0\t21\t1\t5\t\t2\tOK\t1\t0\t0\t0\t1\t1\t6\n"),
      sensors({{"A", "tip"}, {"B", "dorsum"}}));
  ASSERT_EQ(f.frames.size(), 2u);
  EXPECT_EQ(f.frames[0].points.size(), 1u);
  EXPECT_EQ(f.frames[1].points.size(), 2u);
  EXPECT_DOUBLE_EQ(f.frames[1].time_s, 0.02);
  EXPECT_TRUE(says(f, "1 of 4 values left out: their State is not OK"));
}

TEST_F(Formats, XrmbPelletsAreMicrometresAndAMillionIsMissing) {
  const auto path = write(
      "t.txy",
      "0\t1000000\t1000000\t1000000\t1000000\t-12500\t3250\t1000000\t1000000\t1000000\t1000000\t"
      "-45000\t9000\t1000000\t1000000\t1000000\t1000000\n");
  const auto f = read_contours(path, sensors({{"T1", "tip"}, {"T2", "blade"}, {"T4", "dorsum"}}));
  ASSERT_EQ(f.frames[0].points.size(), 2u);
  for (const auto& p : f.frames[0].points)
    EXPECT_NEAR(p.position[0], p.kind == "tip" ? 0.0125 : 0.045, 1e-12);
}

TEST_F(Formats, EstTracksAreTheSameInTextAndInEitherByteOrder) {
  const auto header = [](const std::string& type, const std::string& order) {
    return "EST_File Track\nDataType " + type + "\nByteOrder " + order +
           "\nNumFrames 1\nNumChannels 2\nChannel_0 tt_x\nChannel_1 tt_y\nEST_Header_End\n";
  };
  std::string bytes, swapped;
  for (const float v : {0.25f, 1.0f, 12.5f, -3.25f}) {
    std::string word(reinterpret_cast<const char*>(&v), 4);
    bytes += word;
    swapped += std::string(word.rbegin(), word.rend());
  }
  for (const auto& text : {header("ascii", "01") + "0.25 1 12.5 -3.25\n",
                           header("binary", "01") + bytes, header("binary", "10") + swapped}) {
    ReadOptions o = sensors({{"tt", "tip"}});
    o.facing = "right", o.up = "up";
    const auto f = read_contours(write("a.ema", text), o);
    ASSERT_EQ(f.frames.size(), 1u);
    EXPECT_DOUBLE_EQ(f.frames[0].time_s, 0.25);
    EXPECT_NEAR(f.frames[0].points[0].position[0], -0.0125, 1e-9);
    EXPECT_NEAR(f.frames[0].points[0].position[2], -0.00325, 1e-9);
  }
}

TEST_F(Formats, SsffFilesOfOneTakeAreJoinedByTime) {
  const auto file = [&](const std::string& name, double start, int count) {
    std::string text = fmt::format(
        "SSFF -- (c) SHLRC\nMachine IBM-PC\nRecord_Freq 100\nStart_Time {}\nColumn {}x_raw FLOAT "
        "1\n"
        "Column {}z_raw FLOAT 1\nColumn {}x_filt FLOAT 1\n-----------------\n",
        start, name, name, name);
    for (int s = 0; s < count; ++s)
      for (const float v : {float(10 + 100 * start + s), 5.0f, 99.0f})
        text.append(reinterpret_cast<const char*>(&v), 4);
    return write("s." + name, text);
  };
  const auto f = read_contours(file("TT", 0, 4) + "," + file("TB", 0.02, 2),
                               sensors({{"TT", "tip"}, {"TB", "dorsum"}}));
  ASSERT_EQ(f.frames.size(), 4u);
  EXPECT_EQ(f.frames[1].points.size(), 1u);
  ASSERT_EQ(f.frames[2].points.size(), 2u);
  EXPECT_NEAR(f.frames[2].points[0].position[0], f.frames[2].points[1].position[0], 1e-12);
  EXPECT_TRUE(says(f, "has samples at 2 of the first file's 4 times"));
}

/// Two sensors that move back and forth; what `spoil` does to the first.
std::string moving(const std::function<double(int, double)>& spoil) {
  std::string text =
      "Ch1_X\tCh1_Y\tCh1_Z\tCh1_phi\tCh1_theta\tCh1_RMS\tCh1_Extra\tCh2_X\tCh2_Y\tCh2_Z\tCh2_phi\t"
      "Ch2_theta\tCh2_RMS\tCh2_Extra\n";
  for (int s = 0; s < 40; ++s) {
    const double x = 5 * std::sin(0.3 * s);
    text += fmt::format("{:.2f}\t1\t5\t0\t0\t3\t0\t{:.2f}\t1\t9\t0\t0\t3\t0\n", spoil(s, 20 + x),
                        -10 + x);
  }
  return text;
}

size_t tips(const ContourFile& f) {
  size_t count = 0;
  for (const auto& frame : f.frames)
    for (const auto& p : frame.points) count += p.kind == "tip";
  return count;
}

TEST_F(Formats, FrozenAndJumpingSensorsAreSaidAndLeftOut) {
  const auto named = sensors({{"1", "tip"}, {"2", "dorsum"}});
  const auto good = read_contours(write("g.txt", moving([](int, double x) { return x; })), named);
  EXPECT_EQ(tips(good), 40u);
  const auto frozen = read_contours(
      write("f.txt", moving([](int s, double x) { return s >= 20 ? 20.0 : x; })), named);
  EXPECT_EQ(tips(frozen), 20u);
  EXPECT_TRUE(says(frozen, "sensor 1 is frozen: 20 of 40"));
  const auto spike = read_contours(
      write("s.txt", moving([](int s, double x) { return s == 10 ? 80.0 : x; })), named);
  EXPECT_EQ(tips(spike), 39u);
  EXPECT_TRUE(says(spike, "sensor 1 jumps"));
  const auto off = read_contours(
      write("o.txt", moving([](int s, double x) { return s >= 30 ? x + 40 : x; })), named);
  EXPECT_EQ(tips(off), 30u);
}

}  // namespace
}  // namespace genio
