#include "report/answers/motion_report.hpp"

#include "report/pictures/shape_picture.hpp"
#include "tests/forward/small_model.hpp"
#include "tests/report/markup.hpp"

namespace genio {
namespace {

TEST(MotionReport, WritesAFileAndARowForEachInstant) {
  const Model m = test::small_model();
  Trajectory t;
  for (int i = 0; i < 3; ++i) {
    Instant now;
    now.time = 0.002 * i, now.x = m.rest;
    now.x[3 * m.landmarks.tip] += 1e-3 * i;
    t.instants.push_back(now);
  }
  const test::Folder folder;
  write_motion(m, t, folder.path());
  pugi::xml_document series;
  test::parse(test::content(folder / "motion.pvd"), series);
  int count = 0;
  for (const auto& set : series.child("VTKFile").child("Collection").children("DataSet")) {
    pugi::xml_document frame;
    test::parse(test::content(folder / set.attribute("file").value()), frame);
    EXPECT_DOUBLE_EQ(set.attribute("timestep").as_double(), 0.002 * count);
    ++count;
  }
  EXPECT_EQ(count, 3);
  const auto rows = test::csv(folder / "landmarks.csv");
  ASSERT_EQ(rows.size(), 4u);
  EXPECT_EQ(rows[0][1], "tip_dx_mm");
  for (size_t i = 0; i < 3; ++i) EXPECT_NEAR(std::stod(rows[i + 1][1]), double(i), 1e-9);
}

TEST(ShapePicture, IsWellFormedAndCarriesItsTitle) {
  const Model m = read_model(test::generic_model());
  pugi::xml_document document;
  test::parse(draw_shape(m, m.rest, "GGP & <rest>"), document);
  EXPECT_EQ(test::texts(document).front(), "GGP & <rest>");
}

}  // namespace
}  // namespace genio
