// genio-fuzz-seeds DIR: each reader's seeds in DIR/READER/, and their words in DIR/READER.dict.

#include <cctype>
#include <filesystem>
#include <fstream>
#include <set>
#include <utility>

#include "tests/fuzz/fuzz_reader.hpp"

namespace {

/// Runs of letters, and of what is no blank.
std::set<std::string> words(const std::string& text) {
  std::set<std::string> result;
  const auto collect = [&](const auto& belongs) {
    std::string word;
    for (const char c : text + '\n') {
      const auto u = static_cast<unsigned char>(c);
      if (u > ' ' && u < 127 && c != '"' && c != '\\' && belongs(u)) word += c;
      else if (word.size() > 1 && word.size() < 60) result.insert(std::exchange(word, {}));
      else word.clear();
    }
  };
  collect([](unsigned char c) { return std::isalpha(c) != 0; });
  collect([](unsigned char) { return true; });
  return result;
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 2) return 2;
  const std::filesystem::path folder = arguments[1];
  for (const auto& reader : genio::test::fuzz_readers()) {
    std::filesystem::create_directories(folder / reader.name);
    std::set<std::string> all = {"-1", "0", "2147483648", "1e308", "1e-320", "nan", "inf"};
    for (size_t k = 0; k < reader.seeds.size(); ++k) {
      std::ofstream(folder / reader.name / ("seed" + std::to_string(k)), std::ios::binary)
          << reader.seeds[k];
      all.merge(words(reader.seeds[k]));
    }
    std::ofstream dictionary(folder / (reader.name + ".dict"));
    for (const std::string& word : all) dictionary << '"' << word << "\"\n";
  }
}
