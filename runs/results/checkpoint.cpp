#include "runs/results/checkpoint.hpp"

#include <filesystem>
#include <nlohmann/json.hpp>

#include "forward/base/input_file.hpp"
#include "forward/base/text_file.hpp"
#include "runs/text/nesting.hpp"

namespace genio {

Checkpoint::Checkpoint(const std::string& folder, bool resume)
    : path_(folder.empty() ? "" : folder + "/checkpoint.json") {
  if (!resume || path_.empty()) return;
  std::error_code none;
  if (!std::filesystem::exists(path_, none)) return;  // interrupted before there was anything
  const std::string text = read_file(path_);
  nlohmann::json json;
  if (!nested_too_deep(text)) json = nlohmann::json::parse(text, nullptr, false);
  try {
    for (const auto& z : json.at("unknowns")) {
      const auto values = z.get<std::vector<double>>();
      known_.push_back(Eigen::Map<const Vector>(values.data(), Eigen::Index(values.size())));
    }
  } catch (const nlohmann::json::exception&) {
    throw InputError(path_ +
                     ": is damaged; expected {\"unknowns\": [[number, ...], ...]}. Remove it "
                     "to start again");
  }
}

void Checkpoint::keep(const std::vector<Vector>& unknowns) const {
  if (path_.empty()) return;
  auto json = nlohmann::json::array();
  for (const Vector& z : unknowns) json.push_back(std::vector<double>(z.begin(), z.end()));
  write_text(path_, nlohmann::json{{"unknowns", json}}.dump() + "\n");
}

}  // namespace genio
