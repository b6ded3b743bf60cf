#pragma once

namespace genio::cli {

/// What of a processor the compiler may have used in the program.
struct CompiledFor {
  bool avx2, fma, avx512f, avx512vl;
};
extern const CompiledFor compiled_for;

}  // namespace genio::cli
