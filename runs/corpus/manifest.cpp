#include "runs/corpus/manifest.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <map>
#include <optional>
#include <set>

#include "forward/base/nearest_name.hpp"
#include "inverse/recording/base/table_text.hpp"
#include "inverse/recording/sensors/ssff.hpp"

namespace genio {
namespace {

namespace fs = std::filesystem;

const std::vector<std::string> columns = {"recording", "palate",   "speaker",
                                          "model",     "textgrid", "options"};
constexpr size_t most_lines = 20;  // of bad rows that are named

/// The cells of one row by the name of their column.
using Cells = std::map<std::string, std::string>;

/// What is wrong with a cell.
struct Complaint {
  int line;
  std::string column, what;
};

/// Throws InputError with the first of them, and the lines of the others.
void refuse_rows(const std::string& path, const std::vector<Complaint>& complaints) {
  if (complaints.empty()) return;
  std::set<int> others;
  for (const Complaint& c : complaints)
    if (c.line != complaints.front().line && others.size() < most_lines) others.insert(c.line);
  const Complaint& first = complaints.front();
  throw InputError(fmt::format(
      "{}:{}: column {}: {}{}", path, first.line, first.column, first.what,
      others.empty() ? "" : fmt::format("; also wrong: line {}", fmt::join(others, ", "))));
}

std::vector<std::string> header_of(TableLines& lines, char& separator) {
  std::string line;
  if (!lines.next_filled(line))
    throw InputError(lines.path() + ": is empty; expected a header with the column recording");
  separator = separator_of(line);
  if (separator == ' ') separator = ',';
  std::vector<std::string> names;
  for (const std::string& cell : quoted_cells(line, separator)) {
    const std::string name = lower_case(trimmed(cell));
    if (std::find(columns.begin(), columns.end(), name) == columns.end())
      lines.fail(fmt::format("no such column: {}; did you mean {}? There are {}", in_quotes(cell),
                             nearest_name(name, columns), fmt::join(columns, ", ")));
    if (std::find(names.begin(), names.end(), name) != names.end())
      lines.fail(fmt::format("column {} stands there twice", name));
    names.push_back(name);
  }
  if (std::find(names.begin(), names.end(), "recording") == names.end())
    lines.fail("the column recording is missing");
  return names;
}

/// Why an option cannot stand in a row; empty where it can.
std::string owner_of(const std::string& word) {
  static const std::set<std::string> own = {"--out",  "--resume", "--threads",
                                            "--json", "--quiet",  "--verbose"};
  static const std::map<std::string, std::string> column = {{"--target", "recording"},
                                                            {"--palate", "palate"},
                                                            {"--model", "model"},
                                                            {"--textgrid", "textgrid"}};
  const std::string option = word.substr(0, word.find('='));
  if (own.contains(option))
    return option + " is the corpus's own; give it to `genio corpus` where it has it";
  if (const auto it = column.find(option); it != column.end())
    return fmt::format("{} is not given here but in the column {}", option, it->second);
  return {};
}

std::vector<std::string> words_of_row(const Cells& cells) {
  std::vector<std::string> words;
  for (const auto& [column, option] : {std::pair{"recording", "--target"},
                                       {"palate", "--palate"},
                                       {"model", "--model"},
                                       {"textgrid", "--textgrid"}})
    if (const auto it = cells.find(column); it != cells.end() && !it->second.empty())
      words.insert(words.end(), {option, it->second});
  if (const auto it = cells.find("options"); it != cells.end())
    for (const std::string& word : words_of(it->second)) {
      if (const std::string why = owner_of(word); !why.empty()) throw InputError(why);
      words.push_back(word);
    }
  return words;
}

/// Complaints about the files that a row names.
void check_files(InversionOptions o, const std::function<void(const char*, std::string)>& fail) {
  const auto check = [&](const char* column, const std::string& path) {
    std::error_code none;
    if (!path.empty() && !fs::exists(path, none)) fail(column, path + ": no such file");
  };
  for (const std::string& file : joined_paths(o.measured.target)) check("recording", file);
  for (const OptionFile& file : files_beside(o)) {
    const auto own = std::find(columns.begin(), columns.end(), file.option.substr(2));
    check(own != columns.end() ? own->c_str() : "options", *file.path);
  }
}

std::string from_folder(const std::string& folder, const std::string& path) {
  return (fs::path(folder) / path).lexically_normal().string();
}

/// "recordings/s1/take 3.tsv" as the name of a folder: "recordings_s1_take_3".
std::string folder_name(const std::string& recording) {
  std::string name;
  const fs::path file = fs::path(recording).lexically_normal(),
                 stem = file.parent_path() / file.stem();
  for (const fs::path& part : stem) {
    const std::string word = part.string();
    if (word == "/" || word == ".." || word == "." || word.empty()) continue;
    name += (name.empty() ? "" : "_") + word;
  }
  for (char& c : name)
    if (const auto byte = static_cast<unsigned char>(c);
        byte < 0x80 && !std::isalnum(byte) && c != '-' && c != '.')
      c = '_';
  return name.empty() || name[0] == '.' ? "_" + name : name;
}

/// Rows added at the end leave the names of those before as they were.
std::string free_name(const std::string& recording, std::set<std::string>& taken) {
  static const std::set<std::string> own = {"tasks", "slurm"};
  const std::string name = folder_name(recording);
  std::string tried = name;
  for (int n = 2; own.contains(tried) || !taken.insert(tried).second; ++n)
    tried = fmt::format("{}-{}", name, n);
  return tried;
}

Cells cells_of(const TableLines& lines, const std::string& line, char separator,
               const std::vector<std::string>& names) {
  std::vector<std::string> fields;
  try {
    fields = quoted_cells(line, separator);
  } catch (const InputError& e) {
    lines.fail(e.what());
  }
  if (fields.size() > names.size())
    lines.fail(
        fmt::format("has {} cells, and the header {} columns; put quotes around a cell "
                    "that holds a separator",
                    fields.size(), names.size()));
  Cells cells;
  for (size_t k = 0; k < fields.size(); ++k) {
    const auto first = fields[k].find_first_not_of(" \t"), last = fields[k].find_last_not_of(" \t");
    cells[names[k]] = first == std::string::npos ? "" : fields[k].substr(first, last - first + 1);
  }
  cells.try_emplace("recording", "");
  return cells;
}

/// The row of a line. Hands what is wrong with it to `fail`.
ManifestRow row_of(const Cells& cells, int line, const std::string& folder, const ReadWords& read,
                   const std::function<void(const char*, std::string)>& fail) {
  ManifestRow row;
  row.line = line;
  row.recording = cells.at("recording");
  if (const auto it = cells.find("speaker"); it != cells.end()) row.speaker = it->second;
  if (row.recording.empty()) fail("recording", "is empty; expected the file of a recording");
  try {
    row.words = words_of_row(cells);
    // The generic model stands elsewhere on another machine.
    if (const auto it = cells.find("model"); it == cells.end() || it->second.empty())
      row.words.insert(row.words.end(), {"--model", fs::absolute(read(row.words).model).string()});
    if (!row.recording.empty()) check_files(asked_of(row.words, folder, read), fail);
  } catch (const InputError& e) {
    fail("options", e.what());
  }
  return row;
}

}  // namespace

std::vector<std::string> quoted_cells(const std::string& line, char separator) {
  std::vector<std::string> cells(1);
  bool quoted = false;
  for (size_t i = 0; i < line.size(); ++i) {
    std::string& cell = cells.back();
    if (quoted && line[i] == '"' && i + 1 < line.size() && line[i + 1] == '"') cell += line[i++];
    else if (quoted && line[i] == '"') quoted = false;
    else if (!quoted && line[i] == '"' && trimmed(cell).empty()) quoted = true, cell.clear();
    else if (!quoted && line[i] == separator) cells.emplace_back();
    else cell += line[i];
  }
  if (quoted) throw InputError("a quote is not closed on this line");
  return cells;
}

std::vector<std::string> words_of(const std::string& text) {
  std::vector<std::string> words;
  char quote = 0;
  bool inside = false;
  for (const char c : text) {
    const bool blank = c == ' ' || c == '\t';
    if (quote == 0 && blank) {
      inside = false;
      continue;
    }
    if (!inside) words.emplace_back();
    inside = true;
    if (quote == 0 && (c == '"' || c == '\'')) quote = c;
    else if (quote != 0 && c == quote) quote = 0;
    else words.back() += c;
  }
  if (quote != 0) throw InputError(fmt::format("a quote is not closed in {}", in_quotes(text)));
  return words;
}

InversionOptions asked_of(const std::vector<std::string>& words, const std::string& folder,
                          const ReadWords& read) {
  InversionOptions o = read(words);
  check(o);
  for (const OptionFile& file : files_beside(o))
    if (!file.path->empty()) *file.path = from_folder(folder, *file.path);
  const std::string whole = from_folder(folder, o.measured.target);
  std::vector<std::string> files;
  if (std::error_code none; fs::exists(whole, none)) files = {whole};
  else
    for (const std::string& file : joined_paths(o.measured.target))
      files.push_back(from_folder(folder, file));
  o.measured.target = fmt::format("{}", fmt::join(files, ","));
  return o;
}

Manifest read_manifest(const std::string& path, const ReadWords& read) {
  TableLines lines(path);
  char separator = ',';
  const std::vector<std::string> names = header_of(lines, separator);
  Manifest manifest{path, fs::absolute(path).parent_path().lexically_normal().string(), {}};
  std::vector<Complaint> complaints;
  std::set<std::string> taken;
  for (std::string line; lines.next_filled(line);) {
    const Cells cells = cells_of(lines, line, separator, names);
    ManifestRow row = row_of(cells, lines.number(), manifest.folder, read,
                             [&](const char* column, const std::string& what) {
                               complaints.push_back({lines.number(), column, what});
                             });
    row.name = free_name(row.recording, taken);
    manifest.rows.push_back(std::move(row));
  }
  refuse_rows(path, complaints);
  if (manifest.rows.empty()) throw InputError(path + ": lists no recording");
  return manifest;
}

}  // namespace genio
