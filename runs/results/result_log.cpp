#include "runs/results/result_log.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "forward/base/text_file.hpp"
#include "forward/base/types.hpp"

namespace genio {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

struct ToJson {
  Json operator()(std::monostate) const { return nullptr; }
  template <class T>
  Json operator()(const T& value) const {
    return value;
  }
};

Json to_json(const Question& asked) {
  Json result = Json::object();
  for (const auto& [name, value] : asked) result[name] = std::visit(ToJson(), value);
  return result;
}

/// Throws InputError naming the first option in which the run of `path` differs from what is asked.
void check_same_question(const std::string& folder, const std::string& path, const Json& asked) {
  const Json before = Json::parse(std::ifstream(path), nullptr, false);
  if (!before.is_object())
    throw InputError(path + ": is damaged; name another --out, or remove the folder");
  for (const auto& [key, value] : asked.items())
    if (const Json earlier = before.value(key, Json()); earlier != value)
      throw InputError(fmt::format("--resume: {} was made with {} = {}, not {}", folder, key,
                                   earlier.dump(), value.dump()));
}

}  // namespace

ResultLog::ResultLog(const std::string& folder, const Question& question, bool resume) {
  const std::string path = folder + "/results.jsonl", run = folder + "/run.json";
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw InputError(fmt::format("--out {}: {}", folder, error.message()));
  if (fs::exists(path) && !resume)
    throw InputError(fmt::format(
        "--out {}: holds results already; --resume takes them up, or name another folder", folder));
  const Json asked = to_json(question);
  if (resume && fs::exists(run)) check_same_question(folder, run, asked);
  write_text(run, asked.dump(2) + "\n");
  lines_.emplace(path, [&](const std::string& line) {
    auto answer = read_record(line);
    if (!answer) return false;
    known_.insert_or_assign(answer->frame, std::move(*answer));
    return true;
  });
}

}  // namespace genio
