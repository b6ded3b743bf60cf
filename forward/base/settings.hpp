#pragma once
#include <map>
#include <string>
#include <vector>

#include "forward/base/types.hpp"

namespace genio {

/// What a model file says of one effect; SI units.
using EffectTable = std::map<std::string, double>;

/// Takes values out of an effect's table and complains about what is left.
class Settings {
 public:
  Settings(const std::string& source, std::string effect, const EffectTable& table)
      : source_(source), effect_(std::move(effect)), table_(table) {}

  double take(const std::string& key, double fallback);
  Vec3 take_point(const std::string& prefix, const Vec3& fallback);
  /// Throws InputError naming the effect and the nearest name when a key was never taken.
  void finish() const;

 private:
  const std::string& source_;
  std::string effect_;
  const EffectTable& table_;
  std::vector<std::string> asked_;
};

}  // namespace genio
