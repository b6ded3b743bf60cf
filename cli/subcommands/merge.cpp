#include "cli/subcommands/merge.hpp"

#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "report/answers/run_summary.hpp"
#include "runs/results/merged_runs.hpp"

namespace genio::cli {
namespace {

struct MergeCommand {
  std::vector<std::string> folders;
  std::string out;
  bool json = false;
};

std::string merge_json(const MergedRuns& runs, const MergeCommand& o) {
  nlohmann::json j{{"folders", o.folders}, {"out", o.out}, {"frames", runs.answers.size()}};
  j["status"] = j["verdict"] = nlohmann::json::object();
  for (const auto& [frame, answer] : runs.answers)
    for (const auto& [key, word] :
         {std::pair{"status", answer.status}, std::pair{"verdict", answer.verdict}})
      j[key][word] = j[key].value(word, 0) + 1;
  return j.dump();
}

int run(const MergeCommand& o) {
  const MergedRuns runs = merged_runs(o.folders);
  write_merged(runs, o.out);
  write_summary(runs.answers, o.out);
  if (o.json) fmt::print("{}\n", merge_json(runs, o));
  else fmt::print("{}", summary_text(runs.answers));
  return done;
}

}  // namespace

Runner add_merge(Options& options) {
  auto o = std::make_shared<MergeCommand>();
  options.add("folders", o->folders, "Folders of runs, as `genio invert --out` leaves them",
              {.required = true});
  options.add("--out", o->out, "Folder for all of their results", {.required = true});
  options.flag("--json", o->json, "One JSON object on standard output");
  options.footer("Example: genio merge first second --out both");
  return [o] { return run(*o); };
}

}  // namespace genio::cli
