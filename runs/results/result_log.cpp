#include "runs/results/result_log.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "forward/base/input_file.hpp"
#include "forward/base/text_file.hpp"
#include "forward/base/types.hpp"
#include "runs/text/nesting.hpp"

namespace genio {

namespace fs = std::filesystem;

namespace {

constexpr const char* deadline = "deadline_s";  // of each frame; 0: none

}  // namespace

std::string asked_in(const std::string& folder) {
  const std::string path = folder + "/run.json";
  if (std::error_code none; !fs::exists(path, none))
    throw InputError(path + ": no such file; expected the folder of a run");
  const std::string text = read_file(path, largest_settings);
  if (nested_too_deep(text) || !nlohmann::json::parse(text, nullptr, false).is_object())
    throw InputError(path + ": is damaged; name another --out, or remove the folder");
  return text;
}

bool add_answer(AnswerRecords& answers, AnswerRecord answer, const std::string& folder) {
  const auto [at, fresh] = answers.try_emplace(answer.frame, answer);
  if (!fresh && !agree(at->second, answer))
    throw InputError(fmt::format(
        "{}: frame {} has two answers that differ; remove the wrong one from results.jsonl", folder,
        answer.frame));
  return fresh;
}

void make_result_folder(const std::string& folder, const std::string& otherwise) {
  make_folder(folder);
  if (fs::exists(folder + "/results.jsonl"))
    throw InputError(fmt::format("--out {}: holds results already; {}", folder, otherwise));
}

ResultLog::ResultLog(const std::string& folder, const Question& question, bool resume) {
  const std::string run = folder + "/run.json", asked = question_json(question);
  if (!resume) make_result_folder(folder, "--resume takes them up, or name another folder");
  make_folder(folder);
  bool later = false;
  if (resume && fs::exists(run)) {
    const std::string before = asked_in(folder);
    if (const std::string other = difference(before, asked, deadline); !other.empty())
      throw InputError(fmt::format("--resume: {} was made with {}", folder, other));
    const double earlier = number_in(before, deadline), now = number_in(asked, deadline);
    later = earlier > 0 && (now == 0 || now > earlier);
  }
  write_text(run, asked + "\n");
  lines_.emplace(folder + "/results.jsonl", [&](const std::string& line) {
    auto answer = read_record(line);
    if (answer && later && answer->status == "deadline") return false;
    return answer && add_answer(known_, std::move(*answer), folder);
  });
}

}  // namespace genio
