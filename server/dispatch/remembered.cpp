#include "server/dispatch/remembered.hpp"

namespace genio {

std::vector<std::string> RememberedIds::add(const std::string& id, size_t bytes) {
  ids_.emplace_back(id, bytes), bytes_ += bytes;
  std::vector<std::string> forgotten;
  while (ids_.size() > 1 && (ids_.size() > most_ || bytes_ > most_bytes_)) {
    bytes_ -= ids_.front().second;
    forgotten.push_back(ids_.front().first);
    ids_.pop_front();
  }
  return forgotten;
}

}  // namespace genio
