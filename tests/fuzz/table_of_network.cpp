// What reads bytes from the network. It needs no model, and is built in a minute.

#include "tests/fuzz/fuzz_reader.hpp"

namespace genio::test {

const std::vector<FuzzReader>& fuzz_readers() {
  static const std::vector<FuzzReader> readers = [] {
    std::vector<FuzzReader> all = hub_readers();
    for (FuzzReader& reader : wire_readers()) all.push_back(std::move(reader));
    return all;
  }();
  return readers;
}

}  // namespace genio::test
