# GENIO_ARCH_FLAG: the processor to compile for (docs/building.md).
#   GENIO_NATIVE=ON        the one at hand
#   GENIO_ARCH=auto        x86-64-v3 (AVX2, FMA; Intel since 2013, AMD since 2015) where compiler and
#                          processor know it, else what the compiler takes by itself
#   GENIO_ARCH=x86-64 ...  what is named
include(CheckCXXSourceRuns)
set(GENIO_ARCH_FLAG "")
if(GENIO_NATIVE)
  set(GENIO_ARCH_FLAG -march=native)
elseif(NOT GENIO_ARCH STREQUAL "auto")
  set(GENIO_ARCH_FLAG -march=${GENIO_ARCH})
elseif(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
  set(CMAKE_REQUIRED_FLAGS -march=x86-64-v3)
  set(GENIO_V3_RUNS_EXITCODE 0 CACHE STRING "Of the check where it cannot run, as cross-compiling")
  check_cxx_source_runs("int main() {
      return !(__builtin_cpu_supports(\"avx2\") && __builtin_cpu_supports(\"fma\") &&
               __builtin_cpu_supports(\"bmi2\")); }" GENIO_V3_RUNS)
  unset(CMAKE_REQUIRED_FLAGS)
  if(GENIO_V3_RUNS)
    set(GENIO_ARCH_FLAG -march=x86-64-v3)
  endif()
endif()
message(STATUS "Compiling for: ${GENIO_ARCH_FLAG}")
