#include "inverse/recording/base/head_points.hpp"

#include <optional>
#include <utility>

#include "inverse/recording/base/table_text.hpp"

namespace genio {
namespace {

/// Words that names are made of; those without a point tell nothing.
constexpr std::pair<const char*, std::optional<HeadPoint>> name_words[] = {
    {"hyoid", HeadPoint::hyoid},
    {"shorttendon", HeadPoint::short_tendon},
    {"mandible", HeadPoint::mandible},
    {"jaw", HeadPoint::mandible},
    {"dlc", std::nullopt},
    {"bone", std::nullopt},
    {"shadow", std::nullopt},
    {"spline", std::nullopt},
    {"point", std::nullopt}};

/// The name in small letters without blanks, digits and signs.
std::string letters_of(const std::string& name) {
  std::string letters;
  for (const char c : lower_case(name))
    if ((c >= 'a' && c <= 'z') || c < 0) letters += c;
  return letters;
}

}  // namespace

const char* name_of(HeadPoint point) {
  switch (point) {
    case HeadPoint::hyoid:
      return "hyoid";
    case HeadPoint::short_tendon:
      return "short tendon";
    case HeadPoint::mandible:
      return "mandible";
  }
  return "";
}

std::vector<HeadPoint> head_points_in(const std::string& name) {
  std::vector<HeadPoint> points;
  std::string rest = letters_of(name);
  while (!rest.empty()) {
    bool known = false;
    for (const auto& [word, point] : name_words) {
      if (!rest.starts_with(word)) continue;
      if (point) points.push_back(*point);
      rest.erase(0, std::string(word).size());
      known = true;
      break;
    }
    if (!known) return {};
  }
  return points;
}

}  // namespace genio
