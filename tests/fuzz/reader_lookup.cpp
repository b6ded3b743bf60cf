#include <stdexcept>

#include "tests/fuzz/fuzz_reader.hpp"

namespace genio::test {

const FuzzReader& fuzz_reader(const std::string& name) {
  std::string names;
  for (const FuzzReader& reader : fuzz_readers()) {
    if (reader.name == name) return reader;
    names += " " + reader.name;
  }
  throw std::runtime_error("'" + name + "' is no reader; expected one of" + names);
}

}  // namespace genio::test
