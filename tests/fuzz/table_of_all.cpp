#include "tests/fuzz/fuzz_reader.hpp"

namespace genio::test {

const std::vector<FuzzReader>& fuzz_readers() {
  static const std::vector<FuzzReader> readers = [] {
    std::vector<FuzzReader> all;
    for (auto&& some : {contour_readers(), hub_readers(), model_readers(), run_readers(),
                        speaker_readers(), surface_input_readers(), wire_readers()})
      all.insert(all.end(), some.begin(), some.end());
    return all;
  }();
  return readers;
}

}  // namespace genio::test
