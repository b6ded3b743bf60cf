#include "runs/results/merged_runs.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>

#include "forward/base/input_file.hpp"
#include "forward/base/text_file.hpp"
#include "forward/base/types.hpp"
#include "runs/results/result_log.hpp"

namespace genio {
namespace {

namespace fs = std::filesystem;

/// A last line that was cut off by an interruption is no answer; any other line has to be one.
void add_answers(MergedRuns& runs, const std::string& folder) {
  const std::string path = folder + "/results.jsonl";
  if (std::error_code none; !fs::exists(path, none))
    throw InputError(path + ": no such file; expected the folder of a run");
  check_input(path, largest_whole);
  std::ifstream in(path);
  if (!in) throw InputError(path + ": cannot be read");
  int number = 0;
  for (std::string line; std::getline(in, line);) {
    ++number;
    auto answer = read_record(line);
    if (!answer && (in.eof() || line.empty())) continue;
    if (!answer) throw InputError(fmt::format("{}:{}: is no answer of genio", path, number));
    const int frame = answer->frame;
    const auto earlier = runs.answers.find(frame);
    if (earlier != runs.answers.end() && !agree(earlier->second, *answer))
      throw InputError(fmt::format("merge: frame {} has one answer in {} and another in {}", frame,
                                   runs.folder.at(frame), folder));
    if (add_answer(runs.answers, std::move(*answer), folder)) runs.folder[frame] = folder;
  }
}

void copy_frame_files(int frame, const std::string& folder, const std::string& out) {
  for (const char* ending : {".json", ".csv", ".svg", ".png", ".vtu"}) {
    const std::string name = "/" + frame_name(frame) + ending;
    if (std::error_code none; !fs::exists(folder + name, none)) continue;
    replace_file(out + name, [&](const std::string& file) {
      std::error_code error;
      fs::copy_file(folder + name, file, fs::copy_options::overwrite_existing, error);
      if (error) throw InputError(out + name + ": cannot be written: " + error.message());
    });
  }
}

}  // namespace

MergedRuns answers_in(const std::vector<std::string>& folders) {
  MergedRuns runs;
  for (const std::string& folder : folders) {
    const std::string asked = asked_in(folder);
    if (runs.question.empty()) runs.question = asked;
    else if (const std::string other = difference(runs.question, asked); !other.empty())
      throw InputError(
          fmt::format("merge: {} was made with {} as in {}", folders.front(), other, folder));
    add_answers(runs, folder);
  }
  return runs;
}

MergedRuns merged_runs(const std::vector<std::string>& folders) {
  MergedRuns runs = answers_in(folders);
  if (runs.answers.empty()) throw InputError("merge: there is no answer in these folders");
  return runs;
}

void write_merged(const MergedRuns& runs, const std::string& out) {
  make_result_folder(out, "name another folder");
  std::string lines;
  for (const auto& [frame, answer] : runs.answers) {
    copy_frame_files(frame, runs.folder.at(frame), out);
    lines += answer.line + "\n";
  }
  write_text(out + "/run.json", runs.question);
  write_text(out + "/results.jsonl", lines);
}

}  // namespace genio
