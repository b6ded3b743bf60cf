#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "bench/experiments/hidden_change.hpp"
#include "bench/figures/discover.hpp"

namespace genio::bench {
namespace {

TEST(DiscoverCases, HoldEveryMeasuredOneByItsName) {
  std::set<std::string> names;
  for (const HiddenCase& c : discover_cases()) names.insert(c.name);
  std::ifstream measured(GENIO_SOURCE_DIR "/bench/results/discover.jsonl");
  int count = 0;
  for (std::string line; std::getline(measured, line); ++count) {
    const std::string name = Json::parse(line)["case"];
    EXPECT_TRUE(names.contains(name)) << name;
  }
  EXPECT_GT(count, 100);
}

TEST(DiscoverCases, ALaterHiddenChangeTakesNoSeedOfAnother) {
  std::set<unsigned> numbers;
  for (const std::string& name : hidden_names())
    EXPECT_TRUE(numbers.insert(hidden_number(name)).second) << name;
  EXPECT_EQ(*numbers.begin(), 1u);
  // Seeds up to 7009 belong to those that were measured first.
  EXPECT_GT(100 * hidden_number("an effect of tomorrow"), 7009u);
}

}  // namespace
}  // namespace genio::bench
