#pragma once
#include "bench/problems/benchmark.hpp"

namespace genio::bench {

/// The forward results of Gerard, Perrier & Payan, "3D biomechanical tongue modeling to study
/// speech production", section 5.3, computed on any tongue. The paper's five rows with the cadaver
/// and the living constants, its forces read per side and in all, contact off, with the palate,
/// with the jaw (which carries the lower incisors) and with both: what moved, beside what the paper
/// prints; and how sharp the styloglossus' edges are. Writes suite.json, suite.csv and pictures
/// into the folder --out where that is given.
Benchmark seed_suite_bench();

}  // namespace genio::bench
