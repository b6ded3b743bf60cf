#include "runs/results/question.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "runs/results/content_hash.hpp"

namespace genio {
namespace {

using Json = nlohmann::json;

struct ValueToJson {
  Json operator()(std::monostate) const { return nullptr; }
  Json operator()(const AskedFile& file) const {
    return file.path.empty() ? Json() : Json{{"file", file.path}, {"content", file.content}};
  }
  template <class T>
  Json operator()(const T& value) const {
    return value;
  }
};

bool is_file(const Json& value) {
  return value.is_object() && value.contains("content") && value.contains("file");
}

}  // namespace

AskedFile asked_file(const std::string& path) {
  return {path, path.empty() ? "" : content_hash(path)};
}

std::string question_json(const Question& asked) {
  Json result = Json::object();
  for (const auto& [name, value] : asked) result[name] = std::visit(ValueToJson(), value);
  return result.dump(2, ' ', false, Json::error_handler_t::replace);
}

std::string difference(const std::string& before_json, const std::string& now_json,
                       const std::string& aside) {
  const Json before = Json::parse(before_json), now = Json::parse(now_json);
  for (const auto& [key, value] : now.items()) {
    if (key == aside) continue;
    if (!before.contains(key)) return fmt::format("an earlier Genio, which did not keep {}", key);
    const Json& earlier = before[key];
    if (is_file(earlier) && is_file(value)) {
      if (earlier["content"] == value["content"]) continue;
      return fmt::format("{} = {}, whose content is not that of {}", key, earlier["file"].dump(),
                         value["file"].dump());
    }
    if (earlier == value) continue;
    const auto shown = [](const Json& v) { return is_file(v) ? v["file"].dump() : v.dump(); };
    return fmt::format("{} = {}, not {}", key, shown(earlier), shown(value));
  }
  return {};
}

double number_in(const std::string& question, const std::string& option) {
  const Json asked = Json::parse(question);
  return asked.contains(option) && asked[option].is_number() ? asked[option].get<double>() : 0;
}

}  // namespace genio
