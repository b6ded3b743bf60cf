// What a run left, to be taken up or merged.

#include <filesystem>

#include "runs/results/checkpoint.hpp"
#include "runs/results/content_hash.hpp"
#include "runs/results/merged_runs.hpp"
#include "runs/results/result_log.hpp"
#include "tests/fuzz/fuzz_reader.hpp"

namespace genio::test {
namespace {

std::string folder_of(const std::string& path) {
  return std::filesystem::path(path).parent_path().string();
}

Question question() {
  return {
      {"target", AskedFile{"word.csv", "0123456789abcdef"}}, {"starts", 3}, {"bilateral", true}};
}

std::string answer(int frame) {
  return "{\"frame\":" + std::to_string(frame) +
         ",\"time_s\":0.1,\"label\":\"a\",\"recording\":\"r\",\"speaker\":\"\",\"status\":"
         "\"converged\",\"verdict\":\"explained\",\"rms_mm\":0.3,\"max_mm\":1,\"forces_N\":{"
         "\"GGP\":"
         "1.5},\"sd_N\":{\"GGP\":0.2},\"activation\":{\"GGP\":0.1},\"estimated\":{\"z\":{\"value\":"
         "1}},\"registration\":{\"scale\":1,\"tilt_deg\":2,\"doubtful\":false}}\n";
}

}  // namespace

std::vector<FuzzReader> run_readers() {
  const std::string run = question_json(question()) + "\n";
  return {{"run_json",
           "run.json",
           {run, "{\"target\":null,\"starts\":[1,{\"a\":\"b\"}]}"},
           [run](const std::string& path) { difference(asked_in(folder_of(path)), run); }},
          {"results_jsonl",
           "results.jsonl",
           {answer(1) + answer(2), answer(1) + answer(3).substr(0, 40)},
           [](const std::string& path) {
             merged_runs({folder_of(path)});
             ResultLog(folder_of(path), question(), true);
           },
           {{"run.json", run}}},
          {"checkpoint",
           "checkpoint.json",
           {"{\"unknowns\":[[0.1,-2e-3],[1,2,3]]}\n"},
           [](const std::string& path) { Checkpoint(folder_of(path), true); }},
          {"content_hash",
           "model.toml",
           {"mesh = \"mesh.vtu\"\n"},
           [](const std::string& path) { content_hash(path); },
           {{"mesh.vtu", "<VTKFile/>"}}}};
}

}  // namespace genio::test
