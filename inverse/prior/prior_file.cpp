#include "inverse/prior/prior_file.hpp"

#include <filesystem>

#include "forward/base/toml_reader.hpp"

namespace genio {
namespace {

std::vector<std::string> known_keys(const Prior& prior) {
  std::vector<std::string> keys;
  prior.each([&]<class Term>(const Term&) {
    for (const std::string& key : Term::keys()) keys.push_back(key);
  });
  return keys;
}

}  // namespace

Prior read_prior(const std::string& path) {
  Prior prior;
  if (std::filesystem::path(path).extension() == ".csv") {
    prior.emg = EmgTerm::read_table(path).emg;
    return prior;
  }
  const TomlReader file(path);
  file.only(file.root(), known_keys(prior));
  prior.each([&]<class Term>(Term& term) { term = Term::read(file); });
  return prior;
}

}  // namespace genio
