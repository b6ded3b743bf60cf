#include "report/answers/answer_report.hpp"

#include <nlohmann/json.hpp>

#include "forward/model/build_model.hpp"
#include "report/answers/answer_table.hpp"
#include "tests/forward/small_model.hpp"
#include "tests/report/markup.hpp"

namespace genio {
namespace {

/// An answer of two muscles and one other unknown, of numbers that can be told apart.
AnswerView some_answer() {
  AnswerView v;
  v.title = "frame 1: <a> & \"b\"", v.status = "converged", v.verdict = "explained";
  Estimate first;
  first.name = "GGP", first.best = 2.25, first.maximum = 20.5, first.sd = 0.375;
  first.low = 1.75, first.high = 3.125;
  first.acts = 0.9375, first.median = 2.125, first.mean = 2.375;
  Estimate second = first;
  second.name = "STY", second.best = 0.625, second.maximum = 6.5, second.sd = 0.125;
  second.low = 0.25, second.high = 0.875;
  second.acts = 0.625, second.median = 0.5, second.mean = 0.375;
  v.muscles = {first, second};
  Estimate angle = first;
  angle.name = "jaw_opening.angle", angle.unit = "deg", angle.best = 4.5, angle.sd = 0.5;
  angle.low = 3.5, angle.high = 5.5;
  v.others = {angle};
  v.rms_mm = 0.375, v.max_mm = 1.125, v.chi2_per_dof = 1.25;
  v.unidentified = {{"GGP", "STY"}, {"STY", "GGP"}};
  v.joint = {{{"GGP", "STY"}, 0.96875, 0.5, 3.5}};
  v.measured = {{0.08, 0.11}, {0.09, 0.12}};
  return v;
}

class AnswerReport : public testing::Test {
 protected:
  void SetUp() override { write_report(model, view, 1, folder.path(), "frame"); }
  const Model model = read_model(test::generic_model());
  const AnswerView view = some_answer();
  const test::Folder folder;
};

TEST_F(AnswerReport, HoldsEveryNumberOfTheTableInItsJson) {
  const auto j = nlohmann::json::parse(test::content(folder / "frame.json"));
  EXPECT_EQ(j["frame"], 1);
  EXPECT_EQ(j["status"], view.status);
  EXPECT_EQ(j["verdict"], view.verdict);
  for (const Estimate& m : view.muscles) {
    EXPECT_EQ(j["forces_N"][m.name], m.best);
    EXPECT_EQ(j["sd_N"][m.name], m.sd);
    EXPECT_EQ(j["interval90_N"][m.name], (nlohmann::json{m.low, m.high}));
    EXPECT_EQ(j["activation"][m.name], m.best / m.maximum);
  }
  for (const Estimate& u : view.others) {
    EXPECT_EQ(j["estimated"][u.name]["value"], u.best);
    EXPECT_EQ(j["estimated"][u.name]["unit"], u.unit);
    EXPECT_EQ(j["estimated"][u.name]["sd"], u.sd);
    EXPECT_EQ(j["estimated"][u.name]["interval90"], (nlohmann::json{u.low, u.high}));
  }
  EXPECT_EQ(j["rms_mm"], view.rms_mm);
  EXPECT_EQ(j["max_mm"], view.max_mm);
  EXPECT_EQ(j["chi2_per_dof"], view.chi2_per_dof);
  EXPECT_EQ(j["unidentified"], nlohmann::json(view.unidentified));
  for (const Estimate& m : view.muscles) {
    EXPECT_EQ(j["acts"][m.name], m.acts);
    EXPECT_EQ(j["median_N"][m.name], m.median);
    EXPECT_EQ(j["mean_N"][m.name], m.mean);
  }
  EXPECT_EQ(j["either"][0]["muscles"], nlohmann::json(view.joint[0].names));
  EXPECT_EQ(j["either"][0]["interval90_N"], (nlohmann::json{0.5, 3.5}));
}

TEST_F(AnswerReport, HoldsEveryForceOfTheTableInItsCsv) {
  const auto rows = test::csv(folder / "frame.csv");
  ASSERT_EQ(rows.size(), 1 + view.muscles.size());
  EXPECT_EQ(rows[0],
            (std::vector<std::string>{"muscle", "force_N", "max_force_N", "sd_N", "low90_N",
                                      "high90_N", "acts", "median_N", "mean_N"}));
  for (size_t i = 0; i < view.muscles.size(); ++i) {
    const Estimate& m = view.muscles[i];
    EXPECT_EQ(rows[i + 1][0], m.name);
    const double values[] = {m.best, m.maximum, m.sd, m.low, m.high, m.acts, m.median, m.mean};
    for (size_t k = 0; k < std::size(values); ++k)
      EXPECT_EQ(std::stod(rows[i + 1][k + 1]), values[k]);
  }
}

TEST_F(AnswerReport, SaysEveryNumberInItsTable) {
  const std::string table = to_table(view);
  for (const char* number : {"2.25", "0.62", "11.0", "1.75 to 3.12", "94 %", "62 %", "2.12", "4.5",
                             "3.5 to 5.5", "0.38 mm", "1.12 mm", "1.25", "open GGP, STY",
                             "GGP or STY, together 0.50 to 3.50 N", "cannot tell apart: GGP, STY"})
    EXPECT_NE(table.find(number), std::string::npos) << number << " in\n" << table;
  EXPECT_EQ(table.find("STY, GGP"), std::string::npos) << "said twice in\n" << table;
}

TEST_F(AnswerReport, SaysVerdictFitAndLargestForcesInOneLine) {
  EXPECT_EQ(to_line(view),
            view.title + ": explained, RMS 0.38 mm; GGP 1.75 to 3.12 N, STY 0.25 to 0.88 N");
  AnswerView none;
  none.title = "frame 2", none.status = "failed", none.message = "no points";
  EXPECT_EQ(to_line(none), "frame 2: failed: no points");
}

TEST_F(AnswerReport, DrawsABarForEachMuscleAndADotForEachMeasuredPoint) {
  pugi::xml_document document;
  test::parse(test::content(folder / "frame.svg"), document);
  EXPECT_EQ(test::count(document, "circle", "fill", "white"), int(view.muscles.size()));
  EXPECT_EQ(test::count(document, "circle", "stroke", "white"), int(view.measured.size()));
  const auto words = test::texts(document);
  for (const Estimate& m : view.muscles)
    EXPECT_NE(std::find(words.begin(), words.end(), m.name), words.end()) << m.name;
  EXPECT_EQ(words.front(), view.title);
}

TEST_F(AnswerReport, DrawsBarsFromTheLowToTheHighEndPalerForWhatMayRest) {
  pugi::xml_document document;
  test::parse(test::content(folder / "frame.svg"), document);
  std::vector<double> lengths;
  std::vector<std::string> colours;
  for (const auto& bar : document.child("svg").children("rect"))
    if (bar.attribute("fill").value() != std::string("none") && bar.attribute("y").as_double() > 0)
      lengths.push_back(bar.attribute("width").as_double()),
          colours.push_back(bar.attribute("fill").value());
  ASSERT_EQ(lengths.size(), 2u);
  const auto length = [&](size_t i) {
    return (view.muscles[i].high - view.muscles[i].low) / view.muscles[i].maximum;
  };
  EXPECT_NEAR(lengths[0] / lengths[1], length(0) / length(1), 5e-3);
  EXPECT_LT(colours[0], colours[1]);  // darker
}

TEST_F(AnswerReport, IsDrawnWithoutAnyAnswer) {
  AnswerView failed;
  failed.title = "frame 2", failed.status = "failed", failed.message = "no equilibrium";
  pugi::xml_document document;
  test::parse(draw(model, failed), document);
  EXPECT_EQ(test::count(document, "circle", "fill", "white"), 0);
  EXPECT_NE(to_table(failed).find("no equilibrium"), std::string::npos);
}

}  // namespace
}  // namespace genio
