#pragma once
#include "bench/problems/benchmark.hpp"

namespace genio::bench {

/// Small deformation beside large, muscle by muscle and force by force, as section 5.1 of Gerard,
/// Perrier & Payan compares them. The large deformation is solved as the model is and without its
/// contacts, of which the linear theory knows nothing.
Benchmark deformation_bench();

}  // namespace genio::bench
