#include "inverse/prior/terms/emg.hpp"

#include <filesystem>

#include "inverse/prior/base/read_normal.hpp"
#include "inverse/recording/base/table_text.hpp"

namespace genio {

void EmgTerm::add_rows(const std::vector<Unknown>& unknowns, PriorRows& rows) const {
  for (const auto& [name, activation] : emg) {
    need_positive(activation.sd, name.c_str());
    for (auto i : muscles_named(unknowns, name, "EMG of"))
      rows.add(i, activation.mean, activation.sd);
  }
}

EmgTerm EmgTerm::read_table(const std::string& path) {
  TableLines lines(path);
  std::string line;
  if (!lines.next(line)) lines.fail("the file is empty; expected the header muscle,mean,sd");
  const auto header = split_fields(line, ',');
  if (header.size() != 3 || trimmed(header[0]) != "muscle" || trimmed(header[1]) != "mean" ||
      trimmed(header[2]) != "sd")
    lines.fail(fmt::format("header {}; expected muscle,mean,sd", in_quotes(line)));
  EmgTerm term;
  while (lines.next(line)) {
    if (trimmed(line).empty()) continue;
    const auto fields = split_fields(line, ',');
    if (fields.size() != 3) lines.fail(fmt::format("{} fields; expected 3", fields.size()));
    Normal activation;
    if (!parse_number(fields[1], activation.mean) || activation.mean < 0 || activation.mean > 1)
      lines.fail(
          fmt::format("field mean: {}; expected an activation from 0 to 1", in_quotes(fields[1])));
    if (!parse_number(fields[2], activation.sd) || !(activation.sd > 0))
      lines.fail(fmt::format("field sd: {}; expected a number above 0", in_quotes(fields[2])));
    if (!term.emg.emplace(trimmed(fields[0]), activation).second)
      lines.fail(fmt::format("muscle {} stands twice", in_quotes(fields[0])));
  }
  if (term.emg.empty()) lines.fail("the file has a header but no muscle");
  return term;
}

EmgTerm EmgTerm::read(const TomlReader& file) {
  const toml::node* node = file.root().get("emg");
  if (!node) return {};
  if (!node->is_table()) {
    const std::string name = file.text(file.root(), "emg");
    if (!file.is_file())
      file.fail(*node,
                "'emg' names a file, and a text that was sent can name none; expected [emg.MUSCLE] "
                "with mean and sd");
    return read_table((std::filesystem::path(file.path()).parent_path() / name).string());
  }
  EmgTerm term;
  for (const auto& [key, value] : *node->as_table()) {
    const std::string name(key.str());
    term.emg[name] = read_activation(file, value, name);
  }
  if (term.emg.empty()) file.fail(*node, "'emg' has no muscle");
  return term;
}

}  // namespace genio
