// PLY, OBJ and STL hold the same surface; what a file claims is held against its length.

#include <gtest/gtest.h>
#include <unistd.h>

#include <Eigen/Geometry>
#include <bit>
#include <cstdint>
#include <filesystem>
#include <fstream>

#include "forward/geometry/triangle_surface.hpp"

namespace genio {
namespace {

class SurfaceFiles : public testing::Test {
 protected:
  SurfaceFiles() { std::filesystem::create_directory(folder); }
  ~SurfaceFiles() override { std::filesystem::remove_all(folder); }
  std::string write(const std::string& name, const std::string& text) {
    std::ofstream(folder / name, std::ios::binary) << text;
    return (folder / name).string();
  }
  TriangleSurface read(const std::string& name, const std::string& text) {
    return read_surface(write(name, text));
  }
  std::string error(const std::string& name, const std::string& text) {
    try {
      read(name, text);
    } catch (const InputError& e) {
      return std::string(e.what()).substr(folder.string().size() + 1);
    }
    return "";
  }
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("genio-surface-" + std::to_string(getpid()));
};

/// A square of two triangles, with a header that the tests change.
std::string square(const std::string& form, const std::string& vertices, const std::string& body) {
  return "ply\nformat " + form + " 1.0\ncomment made by hand\nelement vertex " + vertices +
         "\nproperty float x\nproperty float y\nproperty float z\nelement face 2\n"
         "property list uchar int vertex_indices\nend_header\n" +
         body;
}

const std::string corners = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n", faces = "3 0 1 2\n3 0 2 3\n";

template <class T>
std::string bytes(T value, bool big) {
  const std::string raw(reinterpret_cast<const char*>(&value), sizeof value);
  const bool turned = big != (std::endian::native == std::endian::big);
  return turned ? std::string(raw.rbegin(), raw.rend()) : raw;
}

std::string binary_square(bool big) {
  std::string body;
  for (const float x : {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}) body += bytes(x, big);
  for (const std::array<int32_t, 3>& face : {std::array{0, 1, 2}, std::array{0, 2, 3}}) {
    body += '\3';
    for (const int32_t corner : face) body += bytes(corner, big);
  }
  return body;
}

TEST_F(SurfaceFiles, AllFormatsHoldTheSameSurface) {
  const TriangleSurface ascii = read("a.ply", square("ascii", "4", corners + faces));
  ASSERT_EQ(ascii.vertices.size(), 4u);
  EXPECT_EQ(ascii.triangles, (std::vector<std::array<int, 3>>{{0, 1, 2}, {0, 2, 3}}));
  const std::vector<TriangleSurface> others = {
      read("l.ply", square("binary_little_endian", "4", binary_square(false))),
      read("b.ply", square("binary_big_endian", "4", binary_square(true))),
      read("o.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1/1 2/2/1 3//1\nf -4 -2 \\\n-1\n"),
      read("q.OBJ", "v 0 0 0\nv 1 0 0\r\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n"),
      read("s.stl",
           "solid a solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n"
           "vertex 1 1 0\nendloop\nendfacet\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\n"
           "vertex 1 1 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid\n")};
  for (const TriangleSurface& other : others) {
    EXPECT_EQ(other.vertices, ascii.vertices);
    EXPECT_EQ(other.triangles, ascii.triangles);
  }
}

TEST_F(SurfaceFiles, BinaryStlIsKnownByItsLength) {
  std::string text = "solid, says this header, and it is binary";
  text.resize(80, ' ');
  text += bytes(uint32_t(1), false);
  for (const float x : {0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0}) text += bytes(x, false);
  text += std::string(2, '\0');
  EXPECT_EQ(read("a.stl", text).triangles.size(), 1u);
  text.pop_back();
  EXPECT_NE(error("a.stl", text), "");
  text.replace(0, 5, "plain");
  EXPECT_EQ(error("a.stl", text),
            "a.stl: is no STL file: it does not start with 'solid', and of 133 bytes it names 1 "
            "triangles, which take 134");
}

TEST_F(SurfaceFiles, APointNobodyUsesIsNone) {
  EXPECT_EQ(read("a.ply", square("ascii", "5",
                                 "nan nan nan\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n"
                                 "3 1 2 3\n3 1 3 4\n"))
                .vertices.size(),
            4u);
  EXPECT_EQ(error("a.obj", "v 0 0 0\nv 1 0 0\nv 1e300 1 0\nf 1 2 3\n"),
            "a.obj: a vertex is not finite");
}

TEST_F(SurfaceFiles, FacesOfManyCornersAreSplit) {
  // An L, whose area is 3.
  const auto area = [](const TriangleSurface& s) {
    double sum = 0;
    for (const auto& t : s.triangles)
      sum += 0.5 * (s.vertices[size_t(t[1])] - s.vertices[size_t(t[0])])
                       .cross(s.vertices[size_t(t[2])] - s.vertices[size_t(t[0])])
                       .norm();
    return sum;
  };
  const std::string l = "v 0 0 5\nv 2 0 5\nv 2 1 5\nv 1 1 5\nv 1 2 5\nv 0 2 5\n";
  for (const char* face : {"f 1 2 3 4 5 6\n", "f 6 5 4 3 2 1\n", "f 4 5 6 1 2 3\n"}) {
    const TriangleSurface s = read("l.obj", l + face);
    EXPECT_EQ(s.triangles.size(), 4u);
    EXPECT_NEAR(area(s), 3, 1e-12) << face;
  }
  EXPECT_NEAR(area(read("a.obj", "v 0 0 0\nv 2 1 0\nv 4 0 0\nv 2 4 0\nf 1 2 3 4\n")), 6, 1e-12);
}

TEST_F(SurfaceFiles, ClaimsAreHeldAgainstTheLength) {
  EXPECT_EQ(error("a.ply", square("ascii", "4000000000", corners + faces)).substr(0, 49),
            "a.ply: the header names 4000000000 elements 'vert");
  EXPECT_NE(error("a.ply", square("binary_little_endian", "18446744073709551615", "")), "");
  const std::string many =
      "ply\nformat binary_little_endian 1.0\nelement vertex 1\n"
      "property float x\nproperty float y\nproperty float z\n"
      "element nothing 18446744073709551615\nelement face 1\n"
      "property list uint int vertex_indices\nend_header\n";
  EXPECT_EQ(error("a.ply", many + std::string(12, '\0') + std::string(8, '\xFF')),
            "a.ply: face 1: a list of 4294967295 values");
  EXPECT_EQ(error("a.ply", "ply\nformat ascii 1.0\nelement vertex 1"),
            "a.ply:3: the header has no 'end_header'");
}

TEST_F(SurfaceFiles, FaultsAreNamed) {
  EXPECT_EQ(error("a.ply", square("ascii", "4", corners + "3 0 1 7\n3 0 2 3\n")),
            "a.ply: face 1: names point 7; expected 0 to 3");
  EXPECT_EQ(error("a.ply", square("ascii", "4", "0 0 0\n1 0 x\n1 1 0\n0 1 0\n" + faces)),
            "a.ply:12: 'x'; expected a number");
  EXPECT_EQ(error("a.ply", square("ascii", "4", corners + "3 0 1 2 9\n3 0 2 3\n")),
            "a.ply: face 1: '9' behind the last property");
  EXPECT_EQ(error("a.ply", square("ascii", "4", corners + "3 0 1 2\n")),
            "a.ply: face 2: the file ends");
  EXPECT_EQ(error("a.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 9\n"),
            "a.obj: a face names point 9; the file has 3");
  EXPECT_EQ(error("a.obj", "v 0 0 0\nf 1 -2 1\n"),
            "a.obj:2: '-2'; expected the number of a point, from 1");
  EXPECT_EQ(error("a.obj", "v 0 0\n"), "a.obj:1: 2 coordinates; expected x, y and z");
  EXPECT_EQ(error("a.stl", "solid\nvertex 0 0 0\nvertex 1 0 0\nendsolid\n"),
            "a.stl:4: a facet of 2 vertices; expected 3");
  EXPECT_EQ(error("a.ply", ""), "a.ply:1: is no PLY file; expected 'ply' in its first line");
  EXPECT_EQ(error("a.obj", ""), "a.obj: the surface has no triangles");
}

TEST_F(SurfaceFiles, NoOtherFileIsOpened) {
  EXPECT_EQ(read("a.obj", "mtllib /dev/zero\nv 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n").vertices.size(),
            3u);
}

TEST_F(SurfaceFiles, AnEdgeOfManyTrianglesTakesNoLonger) {
  std::string text = "v 0 0 0\nv 1 0 0\n";
  for (int k = 0; k < 20000; ++k)
    text += "v 0 1 " + std::to_string(k) + "\nf 1 2 " + std::to_string(k + 3) + "\n";
  EXPECT_EQ(read("fan.obj", text).triangles.size(), 20000u);
}

}  // namespace
}  // namespace genio
