#include "cli/compiled_for.hpp"

namespace genio::cli {
namespace {

#ifdef __AVX2__
constexpr bool avx2 = true;
#else
constexpr bool avx2 = false;
#endif
#ifdef __FMA__
constexpr bool fma = true;
#else
constexpr bool fma = false;
#endif
#ifdef __AVX512F__
constexpr bool avx512f = true;
#else
constexpr bool avx512f = false;
#endif
#ifdef __AVX512VL__
constexpr bool avx512vl = true;
#else
constexpr bool avx512vl = false;
#endif

}  // namespace

constinit const CompiledFor compiled_for = {avx2, fma, avx512f, avx512vl};

}  // namespace genio::cli
