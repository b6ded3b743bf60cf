#pragma once
#include <cstddef>
#include <vector>

namespace genio {

/// Bytes as they go over the wire, held once for all connections that wait for them. It counts
/// itself in `held` while anybody holds it.
class HubMessage {
 public:
  HubMessage(std::vector<char> bytes, size_t& held);
  ~HubMessage();
  HubMessage(const HubMessage&) = delete;
  HubMessage& operator=(const HubMessage&) = delete;

  const std::vector<char>& bytes() const { return bytes_; }

 private:
  size_t cost() const;

  std::vector<char> bytes_;
  size_t& held_;
};

}  // namespace genio
