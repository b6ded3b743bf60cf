#pragma once
// The readers of files that others may have written, as one table: the fuzzer and the replay of its
// corpus both run it.

#include <functional>
#include <map>
#include <string>
#include <vector>

namespace genio::test {

/// A reader. To add one, add a row to one of the *_readers.cpp.
struct FuzzReader {
  std::string name;                ///< also of its folder in tests/fuzz/corpus
  std::string file;                ///< what an input is called; readers go by endings
  std::vector<std::string> seeds;  ///< small whole files, all of which are read
  /// Throws InputError where the file is refused. Whatever else comes out of it is a finding.
  std::function<void(const std::string& path)> read;
  std::map<std::string, std::string> beside = {};  ///< other files of the folder, by name
};

std::vector<FuzzReader> contour_readers();
std::vector<FuzzReader> hub_readers();
std::vector<FuzzReader> model_readers();
std::vector<FuzzReader> run_readers();
std::vector<FuzzReader> surface_input_readers();
std::vector<FuzzReader> speaker_readers();
std::vector<FuzzReader> wire_readers();

/// All of them.
const std::vector<FuzzReader>& fuzz_readers();

/// The reader of that name. Throws std::runtime_error that lists the names.
const FuzzReader& fuzz_reader(const std::string& name);

}  // namespace genio::test
