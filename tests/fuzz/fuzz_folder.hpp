#pragma once
#include "tests/fuzz/fuzz_reader.hpp"

namespace genio::test {

/// A folder, in memory where the system has such, in which a reader finds one input after another.
class FuzzFolder {
 public:
  explicit FuzzFolder(const FuzzReader& reader);
  ~FuzzFolder();
  FuzzFolder(const FuzzFolder&) = delete;
  FuzzFolder& operator=(const FuzzFolder&) = delete;

  /// True where the reader reads the input, false where it refuses it with a reason of one line.
  /// What else it throws passes through.
  bool reads(const std::string& input);

 private:
  const FuzzReader& reader_;
  std::string folder_;
};

}  // namespace genio::test
