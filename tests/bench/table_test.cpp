#include "bench/figures/table.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>

#include "forward/base/types.hpp"

namespace genio::bench {
namespace {

const Progress silent = [](const std::string&) {};

std::string refusal(const std::function<void()>& work) {
  try {
    work();
  } catch (const InputError& e) {
    return e.what();
  }
  return "nothing was refused";
}

TEST(BenchmarkTable, GivesEachBenchmarkANameOfItsOwnAndALineOfHelp) {
  std::set<std::string> names;
  for (const Benchmark& b : benchmarks()) {
    EXPECT_TRUE(names.insert(b.name).second) << b.name;
    EXPECT_FALSE(b.about.empty()) << b.name;
    EXPECT_NE(b.run, nullptr) << b.name;
    EXPECT_EQ(&benchmark(b.name), &b);
  }
}

TEST(BenchmarkTable, HoldsTheBenchmarksOfTheInterface) {
  for (const char* name : {"forward", "dynamic", "inverse", "service", "discover", "corpus",
                           "robustness", "verification", "reach", "peer", "gesture", "ultrasound",
                           "grenoble", "grenoble-gravity", "deformation"})
    EXPECT_EQ(benchmark(name).name, name);
}

TEST(BenchmarkTable, RefusesAnUnknownNameAndListsTheKnownOnes) {
  const std::string words = refusal([] { benchmark("nothing"); });
  EXPECT_NE(words.find("nothing"), std::string::npos);
  EXPECT_NE(words.find("grenoble-gravity"), std::string::npos);
}

TEST(BenchmarkTable, RefusesARunWithoutAnOptionThatItNeeds) {
  for (const Benchmark& b : benchmarks())
    for (const BenchOption& o : b.options)
      if (o.needed) {
        const std::string words = refusal([&] { run_benchmark(b, {}, silent); });
        EXPECT_NE(words.find("bench " + b.name + ": needs --"), std::string::npos) << words;
      }
}

}  // namespace
}  // namespace genio::bench
