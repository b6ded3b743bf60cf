#pragma once
#include <cstddef>
#include <deque>
#include <string>
#include <vector>

namespace genio {

/// Which answers are kept for repeated ids: the newest, so many and of so many bytes. At least one.
class RememberedIds {
 public:
  RememberedIds(int most, size_t most_bytes) : most_(size_t(most)), most_bytes_(most_bytes) {}

  /// Adds one, and gives those that are to be forgotten.
  std::vector<std::string> add(const std::string& id, size_t bytes);

 private:
  size_t most_, most_bytes_, bytes_ = 0;
  std::deque<std::pair<std::string, size_t>> ids_;  // oldest first
};

}  // namespace genio
