// Label volumes: what a header says is where the surface lies; what it cannot say is refused.

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <cstring>

#include "speaker/solid/surface_figures.hpp"
#include "speaker/volume/label_surface.hpp"
#include "tests/speaker/shapes.hpp"

namespace genio {
namespace {

using test::complaint;
using test::ScratchFolder;

/// A volume to be written as a file; the tests change what they are about.
struct VolumeFile {
  std::array<int, 3> size = {24, 22, 20};
  int type = 4, bits = 16;
  bool big = false;
  float slope = 0, intercept = 0, offset = 352;
  std::array<float, 4> rows[3] = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}};
  int sform = 1, qform = 0;
  std::array<float, 4> pixdim = {1, 1, 1, 1};
  std::array<float, 6> quaternion{};
  char unit = 2;
  std::function<double(int, int, int)> value = [](int, int, int) { return 0.0; };

  template <class T>
  void put(std::string& text, size_t at, T number) const {
    char raw[sizeof(T)];
    std::memcpy(raw, &number, sizeof(T));
    if (big) std::reverse(raw, raw + sizeof(T));
    text.replace(at, sizeof(T), raw, sizeof(T));
  }

  void append(std::string& text, double number) const {
    const size_t at = text.size();
    text.resize(at + size_t(bits / 8));
    switch (type) {
      case 2:
        return put(text, at, std::uint8_t(number));
      case 256:
        return put(text, at, std::int8_t(number));
      case 4:
        return put(text, at, std::int16_t(number));
      case 512:
        return put(text, at, std::uint16_t(number));
      case 8:
        return put(text, at, std::int32_t(number));
      case 768:
        return put(text, at, std::uint32_t(number));
      case 1024:
        return put(text, at, std::int64_t(number));
      case 1280:
        return put(text, at, std::uint64_t(number));
      case 16:
        return put(text, at, float(number));
      default:
        return put(text, at, number);
    }
  }

  std::string text() const {
    std::string t(size_t(std::max(offset, 352.f)), '\0');
    put(t, 0, std::int32_t(348));
    put(t, 40, std::int16_t(3));
    for (size_t d = 0; d < 3; ++d) put(t, 42 + 2 * d, std::int16_t(size[d]));
    for (size_t d = 3; d < 7; ++d) put(t, 42 + 2 * d, std::int16_t(1));
    put(t, 70, std::int16_t(type)), put(t, 72, std::int16_t(bits));
    for (size_t d = 0; d < 4; ++d) put(t, 76 + 4 * d, pixdim[d]);
    put(t, 108, offset), put(t, 112, slope), put(t, 116, intercept);
    t[123] = unit;
    put(t, 252, std::int16_t(qform)), put(t, 254, std::int16_t(sform));
    for (size_t k = 0; k < 6; ++k) put(t, 256 + 4 * k, quaternion[k]);
    for (size_t r = 0; r < 3; ++r)
      for (size_t c = 0; c < 4; ++c) put(t, 280 + 16 * r + 4 * c, rows[r][c]);
    t.replace(344, 4, std::string("n+1\0", 4));
    for (int k = 0; value && k < size[2]; ++k)
      for (int j = 0; j < size[1]; ++j)
        for (int i = 0; i < size[0]; ++i) append(t, value(i, j, k));
    return t;
  }
};

/// A ball of label 3 with a speck of label 7 apart from it.
double ball_and_speck(int i, int j, int k) {
  if (std::hypot(i - 11, j - 10, k - 9) < 7.5) return 3;
  return i > 20 && j > 19 && k > 17 ? 7 : 0;
}

VolumeFile with_ball() {
  VolumeFile file;
  file.value = ball_and_speck;
  return file;
}

Vec3 middle(const TriangleSurface& surface) {
  Eigen::AlignedBox3d box;
  for (const Vec3& v : surface.vertices) box.extend(v);
  return box.center();
}

TriangleSurface surface_of(const VolumeFile& file, std::optional<std::int64_t> label = 3,
                           const char* name = "v.nii") {
  const ScratchFolder folder;
  return label_surface(read_labelled_box(folder.write(name, file.text()), label));
}

TEST(Labels, ABallIsAClosedBallOfItsVolumeInItsPlace) {
  const TriangleSurface surface = surface_of(with_ball());
  const SurfaceFigures f = surface_figures(surface);
  EXPECT_TRUE(f.closed && f.manifold);
  EXPECT_EQ(f.euler, 2);
  int voxels = 0;
  for (int i = 0; i < 24; ++i)
    for (int j = 0; j < 22; ++j)
      for (int k = 0; k < 20; ++k) voxels += ball_and_speck(i, j, k) == 3;
  EXPECT_NEAR(f.volume, 1e-9 * voxels, 0.005 * f.volume);
  EXPECT_LT((middle(surface) - 1e-3 * Vec3(11, 10, 9)).norm(), 0.02e-3);
}

TEST(Labels, EveryTypeAndByteOrderReadsAlike) {
  const TriangleSurface plain = surface_of(with_ball());
  for (const auto& [type, bits] : std::vector<std::pair<int, int>>{{2, 8},
                                                                   {256, 8},
                                                                   {4, 16},
                                                                   {512, 16},
                                                                   {8, 32},
                                                                   {768, 32},
                                                                   {1024, 64},
                                                                   {1280, 64},
                                                                   {16, 32},
                                                                   {64, 64}})
    for (const bool big : {false, true}) {
      VolumeFile file = with_ball();
      file.type = type, file.bits = bits, file.big = big, file.offset = big ? 416 : 352;
      const TriangleSurface same = surface_of(file);
      ASSERT_EQ(same.vertices.size(), plain.vertices.size()) << type << big;
      EXPECT_EQ(same.vertices[50], plain.vertices[50]);
    }
}

TEST(Labels, CompressedFilesAndScaledValuesReadAlike) {
  VolumeFile file = with_ball();
  const TriangleSurface plain = surface_of(file);
  const ScratchFolder folder;
  const std::string path = folder.write("v.nii.gz", ""), text = file.text();
  const gzFile out = gzopen(path.c_str(), "wb");
  gzwrite(out, text.data(), unsigned(text.size()));
  gzclose(out);
  EXPECT_EQ(label_surface(read_labelled_box(path, 3)).vertices.size(), plain.vertices.size());
  file.slope = 0.5f, file.intercept = -1;
  file.value = [](int i, int j, int k) { return 2 * (ball_and_speck(i, j, k) + 1); };
  EXPECT_EQ(surface_of(file).vertices.size(), plain.vertices.size());
}

TEST(Labels, LieWhereTheHeaderPutsThem) {
  // Half a millimetre by one by two, turned, mirrored and far off.
  VolumeFile file = with_ball();
  file.rows[0] = {0, -1, 0, 40}, file.rows[1] = {0.5, 0, 0, -30}, file.rows[2] = {0, 0, -2, 5};
  const TriangleSurface by_rows = surface_of(file);
  EXPECT_GT(surface_figures(by_rows).volume, 0);
  EXPECT_LT((middle(by_rows) - 1e-3 * Vec3(30, -24.5, -13)).norm(), 0.05e-3);
  // The same by a quaternion: a quarter turn about z, and the third axis the other way.
  file.sform = 0, file.qform = 1;
  const float root = float(std::sqrt(0.5));
  file.pixdim = {-1, 0.5, 1, 2}, file.quaternion = {0, 0, root, 40, -30, 5};
  const TriangleSurface by_quaternion = surface_of(file);
  EXPECT_LT((middle(by_quaternion) - middle(by_rows)).norm(), 1e-6);
  // By voxel sizes alone, and in micrometres.
  file.qform = 0;
  EXPECT_LT((middle(surface_of(file)) - 1e-3 * Vec3(5.5, 10, 18)).norm(), 0.05e-3);
  file.unit = 3, file.pixdim = {1, 500, 1000, 2000};
  EXPECT_LT((middle(surface_of(file)) - 1e-3 * Vec3(5.5, 10, 18)).norm(), 0.05e-3);
}

TEST(Labels, AtTheVolumesBorderTheSurfaceIsClosed) {
  VolumeFile file;
  file.value = [](int i, int, int) { return i < 6 ? 1.0 : 0.0; };
  const SurfaceFigures f = surface_figures(surface_of(file, {}));
  EXPECT_TRUE(f.closed && f.manifold);
  EXPECT_NEAR(f.volume, 6 * 22 * 20e-9, 0.02 * f.volume);
}

TEST(Labels, APlateOfOneVoxelStays) {
  VolumeFile file;
  file.value = [](int i, int j, int k) {
    return i == 10 && j > 3 && j < 18 && k > 3 && k < 16 ? 1.0 : 0.0;
  };
  EXPECT_EQ(surface_figures(surface_of(file, {})).euler, 2);
}

std::string refusal(const VolumeFile& file, std::optional<std::int64_t> label = 3) {
  const std::string said = complaint([&] { surface_of(file, label); });
  EXPECT_EQ(said.find('\n'), std::string::npos);
  return said;
}

TEST(LabelFile, FaultsAreNamedByField) {
  const auto says = [](const char* what, const std::function<void(VolumeFile&)>& spoil,
                       std::optional<std::int64_t> label = 3) {
    VolumeFile file = with_ball();
    spoil(file);
    const std::string said = refusal(file, label);
    EXPECT_NE(said.find(what), std::string::npos) << what << " | " << said;
  };
  says("every voxel is 0", [](VolumeFile& f) { f.value = [](int, int, int) { return 0.0; }; });
  says(
      "no voxel has the label 5; there are 3, 7", [](VolumeFile&) {}, 5);
  says(
      "has the labels 3, 7; expected --label", [](VolumeFile&) {}, std::nullopt);
  says(
      "label 0", [](VolumeFile&) {}, 0);
  says("field datatype: 128", [](VolumeFile& f) { f.type = 128, f.bits = 24; });
  says("field bitpix", [](VolumeFile& f) { f.bits = 32; });
  says("field vox_offset", [](VolumeFile& f) { f.offset = 100; });
  says("field dim[2]: -4", [](VolumeFile& f) { f.size[1] = -4; });
  says("field dim: ", [](VolumeFile& f) { f.size = {4000, 4000, 4000}, f.value = nullptr; });
  says("field scl_slope", [](VolumeFile& f) { f.slope = NAN; });
  says("field srow_y: is not finite", [](VolumeFile& f) { f.rows[1][2] = INFINITY; });
  says("in one plane", [](VolumeFile& f) {
    f.rows[0] = {1, 0, 1, 0}, f.rows[2] = {0, 0, 0.01f, 0};
  });
  says("a voxel measures", [](VolumeFile& f) { f.unit = 1; });
  says("field xyzt_units", [](VolumeFile& f) { f.unit = 5; });
  says("field quatern_b", [](VolumeFile& f) { f.sform = 0, f.qform = 1, f.quaternion[0] = 2; });
  says("is no label; expected whole numbers", [](VolumeFile& f) {
    f.type = 16, f.bits = 32;
    f.value = [](int i, int, int) { return 0.37 * i; };
  });
  says("more than 1000 values",
       [](VolumeFile& f) { f.value = [](int i, int j, int k) { return i + 30.0 * j + 700 * k; }; });
}

TEST(LabelFile, WhatIsCutOrNoNiftiIsRefused) {
  const ScratchFolder folder;
  const std::string whole = with_ball().text();
  const auto says = [&](const std::string& text, const char* what, const char* name = "v.nii") {
    const std::string path = folder.write(name, text);
    const std::string said = complaint([&] { read_labelled_box(path, 3); });
    EXPECT_NE(said.find(what), std::string::npos) << what << " | " << said;
  };
  says(whole.substr(0, 200), "200 bytes; expected a NIfTI header");
  says(whole.substr(0, 5000), "field dim tells of more voxels");
  says(std::string(400, 'x'), "field sizeof_hdr");
  std::string other = whole;
  other[344] = 'x';
  says(other, "field magic");
  std::string packed = "\x1f\x8b\x08";
  packed += std::string("\0\0\0\0\0\0\3", 7) + std::string(50, '\xff');
  says(packed, "is damaged", "v.nii.gz");
}

}  // namespace
}  // namespace genio
