#include "forward/geometry/mesh.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "tests/forward/small_model.hpp"

namespace genio {
namespace {

HexMesh cube(double side) {
  HexMesh m;
  for (const auto& c : {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0), Vec3(0, 0, 1),
                        Vec3(1, 0, 1), Vec3(1, 1, 1), Vec3(0, 1, 1)})
    m.nodes.push_back(side * c);
  m.elements = {{0, 1, 2, 3, 4, 5, 6, 7}};
  return m;
}

TEST(Mesh, CubeHasItsVolumeSurfaceAndRatioOne) {
  const HexMesh m = cube(0.02);
  EXPECT_NEAR(mesh_volume(m, rest_positions(m)), 8e-6, 1e-18);
  EXPECT_EQ(boundary_quads(m).size(), 6u);
  EXPECT_NEAR(corner_jacobian_ratio(m, 0), 1.0, 1e-12);
  double area = 0;
  for (double a : nodal_areas(m, boundary_quads(m))) area += a;
  EXPECT_NEAR(area, 6 * 4e-4, 1e-15);
}

TEST(Mesh, SurfaceNormalsPointOut) {
  const HexMesh m = test::small_model().mesh;
  Vec3 middle = Vec3::Zero();
  for (const Vec3& x : m.nodes) middle += x / double(m.nodes.size());
  double flux = 0;  // three times the volume, by the divergence theorem
  for (const Quad& q : boundary_quads(m)) {
    const Vec3 normal = (m.nodes[q[2]] - m.nodes[q[0]]).cross(m.nodes[q[3]] - m.nodes[q[1]]) / 2;
    flux +=
        normal.dot((m.nodes[q[0]] + m.nodes[q[1]] + m.nodes[q[2]] + m.nodes[q[3]]) / 4 - middle);
  }
  EXPECT_NEAR(flux / 3, mesh_volume(m, rest_positions(m)), 1e-2 * flux);
}

TEST(Mesh, InvertedElementIsNamed) {
  HexMesh m = cube(0.02);
  std::swap(m.elements[0][0], m.elements[0][4]);
  std::swap(m.elements[0][1], m.elements[0][5]);
  std::swap(m.elements[0][2], m.elements[0][6]);
  std::swap(m.elements[0][3], m.elements[0][7]);
  try {
    check_mesh(m, "file.vtu");
    FAIL();
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("file.vtu: element 0 is inverted"), std::string::npos);
  }
}

TEST(Mesh, WrongUnitsAreSuspected) {
  EXPECT_THROW(check_mesh(cube(100), "m"), InputError);  // millimetres or centimetres as metres
  EXPECT_THROW(check_mesh(cube(1e-4), "m"), InputError);
  EXPECT_NO_THROW(check_mesh(cube(0.07), "m"));
}

}  // namespace
}  // namespace genio
