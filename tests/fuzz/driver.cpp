// libFuzzer's entry: GENIO_FUZZ_READER names the reader (tests/fuzz/run.sh sets it).

#include <cstdint>
#include <cstdlib>
#include <stdexcept>

#include "tests/fuzz/fuzz_folder.hpp"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  static genio::test::FuzzFolder folder = [] {
    const char* name = std::getenv("GENIO_FUZZ_READER");
    return genio::test::FuzzFolder(genio::test::fuzz_reader(name ? name : ""));
  }();
  folder.reads(std::string(reinterpret_cast<const char*>(data), size));
  return 0;
}
