#include "cli/result_log.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>

#include "forward/base/types.hpp"
#include "report/svg.hpp"

namespace genio::cli {

namespace fs = std::filesystem;

ResultLog::ResultLog(const std::string& folder, const nlohmann::json& asked, bool resume) {
  const std::string path = folder + "/results.jsonl";
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw InputError(fmt::format("--out {}: {}", folder, error.message()));
  const std::string run = folder + "/run.json";
  if (fs::exists(path) && !resume)
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
  lines_.emplace(path, "frame");
  for (const auto& answer : lines_->known()) known_[answer["frame"].get<int>()] = answer;
}

}  // namespace genio::cli
