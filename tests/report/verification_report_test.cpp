#include "report/discovery/verification_report.hpp"

#include <nlohmann/json.hpp>

#include "tests/report/markup.hpp"

namespace genio {
namespace {

TEST(VerificationReport, DrawsALineForEachSeriesOfATableWhateverTheOrderOfRows) {
  nlohmann::json tables;
  for (int n : {4, 8})
    for (double nu : {0.3, 0.499}) {
      tables["manufactured"].push_back(
          {{"poisson_ratio", nu}, {"distortion", 0.0}, {"n", n}, {"relative_l2_error", 1.0 / n}});
      tables["cook"].push_back({{"poisson_ratio", nu}, {"n", n}, {"corner_mm", 1.0 * n}});
    }
  for (const char* code : {"ours", "peer"}) {
    tables["block"].push_back({{"code", code}, {"elements", 64}, {"mm", {1.0, 0.0, 0.0}}});
    tables["time"].push_back({{"scheme", code}, {"step_ms", 2.0}, {"relative_error", 1e-3}});
  }
  const test::Folder folder;
  write_verification(tables, folder.path());
  EXPECT_EQ(nlohmann::json::parse(test::content(folder / "verification.json")), tables);
  for (const char* name : {"manufactured.svg", "cook.svg", "block.svg", "time.svg"}) {
    pugi::xml_document document;
    test::parse(test::content(folder / name), document);
    const auto lines = document.child("svg").children("polyline");
    EXPECT_EQ(std::distance(lines.begin(), lines.end()), 2) << name;
  }
}

}  // namespace
}  // namespace genio
