#include "cli/processor_check.hpp"

#include <cstdio>
#include <cstdlib>

#include "cli/command_line/command.hpp"
#include "cli/compiled_for.hpp"

// Compiled for the oldest processor of its kind (genio_checks_processor() in CMake), so that it can
// say what is wrong.

namespace genio::cli {

#if defined(__x86_64__)

const char* lacking_of_processor() {
  __builtin_cpu_init();
  if (compiled_for.avx2 && !__builtin_cpu_supports("avx2")) return "AVX2";
  if (compiled_for.fma && !__builtin_cpu_supports("fma")) return "FMA";
  if (compiled_for.avx512f && !__builtin_cpu_supports("avx512f")) return "AVX-512F";
  if (compiled_for.avx512vl && !__builtin_cpu_supports("avx512vl")) return "AVX-512VL";
  return nullptr;
}

#else

const char* lacking_of_processor() { return nullptr; }

#endif

namespace {

// Before the initialisers of all other files, which may use what is lacking.
[[gnu::constructor(101)]] void check_processor() {
  const char* lacking = lacking_of_processor();
  if (!lacking) return;
  std::fprintf(stderr,
               "genio: compiled for a processor with %s, which this one lacks; build it with "
               "cmake --preset portable, or with -DGENIO_ARCH=x86-64\n",
               lacking);
  std::_Exit(no_answer);
}

}  // namespace
}  // namespace genio::cli
