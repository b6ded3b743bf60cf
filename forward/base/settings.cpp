#include "forward/base/settings.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "forward/base/nearest_name.hpp"

namespace genio {

double Settings::take(const std::string& key, double fallback) {
  asked_.push_back(key);
  const auto it = table_.find(key);
  return it == table_.end() ? fallback : it->second;
}

Vec3 Settings::take_point(const std::string& prefix, const Vec3& fallback) {
  return {take(prefix + "x", fallback[0]), take(prefix + "y", fallback[1]),
          take(prefix + "z", fallback[2])};
}

void Settings::finish() const {
  for (const auto& [key, value] : table_)
    if (std::find(asked_.begin(), asked_.end(), key) == asked_.end())
      throw InputError(fmt::format("{}: [effect.{}] has no parameter '{}'; did you mean {}?",
                                   source_, effect_, key, nearest_name(key, asked_)));
}

}  // namespace genio
