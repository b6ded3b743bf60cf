#include "inverse/prior/prior_file.hpp"

#include <filesystem>
#include <sstream>

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

Prior prior_in(const TomlReader& file) {
  Prior prior;
  file.only(file.root(), known_keys(prior));
  prior.each([&]<class Term>(Term& term) { term = Term::read(file); });
  return prior;
}

bool is_table_of_emg(const std::string& path) {
  return std::filesystem::path(path).extension() == ".csv";
}

toml::table emg_table(const Prior& prior) {
  toml::table table;
  for (const auto& [muscle, activation] : prior.emg)
    table.insert(muscle, toml::table{{"mean", activation.mean}, {"sd", activation.sd}});
  return table;
}

}  // namespace

Prior read_prior(const std::string& path) {
  if (!is_table_of_emg(path)) return prior_in(TomlReader(path));
  Prior prior;
  prior.emg = EmgTerm::read_table(path).emg;
  return prior;
}

Prior prior_of_text(const std::string& name, const std::string& text) {
  return prior_in(TomlReader::of_text(name, text));
}

std::string prior_text(const std::string& path) {
  const Prior prior = read_prior(path);
  toml::table root;
  if (!is_table_of_emg(path)) {
    root = TomlReader(path).root();
    if (const auto* emg = root.get("emg"); !emg || emg->is_table())
      return read_file(path, largest_settings);
  }
  root.insert_or_assign("emg", emg_table(prior));
  std::ostringstream text;
  text << root << '\n';
  return text.str();
}

}  // namespace genio
