#include "cli/result_log.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "forward/types.hpp"
#include "report/svg.hpp"

namespace genio::cli {

namespace fs = std::filesystem;

ResultLog::ResultLog(const std::string& folder, const nlohmann::json& asked, bool resume)
    : path_(folder + "/results.jsonl") {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw InputError(fmt::format("--out {}: {}", folder, error.message()));
  const std::string run = folder + "/run.json";
  if (fs::exists(path_) && !resume)
    throw InputError(fmt::format(
        "--out {}: holds results already; --resume takes them up, or name another folder", folder));
  if (resume && fs::exists(run)) {
    const auto before = nlohmann::json::parse(std::ifstream(run), nullptr, false);
    for (const auto& [key, value] : asked.items())
      if (before.value(key, nlohmann::json()) != value)
        throw InputError(fmt::format("--resume: {} was made with {} = {}, not {}", folder, key,
                                     before.value(key, nlohmann::json()).dump(), value.dump()));
  }
  write_text(run, asked.dump(2) + "\n");
  std::string whole;
  if (std::ifstream in(path_); in)
    for (std::string line; std::getline(in, line);) {
      const auto answer = nlohmann::json::parse(line, nullptr, false);
      if (!answer.is_object() || !answer.contains("frame")) continue;  // cut off in mid-line
      known_[answer["frame"].get<int>()] = answer;
      whole += line + "\n";
    }
  // A line without its end would swallow the next one.
  write_text(path_ + ".new", whole);
  fs::rename(path_ + ".new", path_, error);
  if (error) throw InputError(fmt::format("{}: {}", path_, error.message()));
  out_.open(path_, std::ios::app);
  if (!out_) throw InputError(path_ + ": cannot be written");
}

void ResultLog::add(const nlohmann::json& answer) {
  out_ << answer.dump() << '\n' << std::flush;
  if (!out_) throw InputError(path_ + ": cannot be written (disk full?)");
}

}  // namespace genio::cli
