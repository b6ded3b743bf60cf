#include "tests/fuzz/fuzz_reader.hpp"

#include <stdexcept>

namespace genio::test {

const std::vector<FuzzReader>& fuzz_readers() {
  static const std::vector<FuzzReader> readers = [] {
    std::vector<FuzzReader> all;
    for (auto&& some :
         {contour_readers(), hub_readers(), model_readers(), run_readers(), wire_readers()})
      all.insert(all.end(), some.begin(), some.end());
    return all;
  }();
  return readers;
}

const FuzzReader& fuzz_reader(const std::string& name) {
  std::string names;
  for (const FuzzReader& reader : fuzz_readers()) {
    if (reader.name == name) return reader;
    names += " " + reader.name;
  }
  throw std::runtime_error("'" + name + "' is no reader; expected one of" + names);
}

}  // namespace genio::test
