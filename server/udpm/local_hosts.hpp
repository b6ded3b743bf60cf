#pragma once
#include <netinet/in.h>

#include <optional>
#include <vector>

#include "server/udpm/limits.hpp"

namespace genio {

/// Which addresses are this host's own. 0.0.0.0 is: so sends a host that has only its loopback
/// interface, and from elsewhere the system takes it for no group but 224.0.0.x.
class LocalHosts {
 public:
  /// The system is asked at most once a second for the addresses of its interfaces. Whether one can
  /// be bound to would say less: with net.ipv4.ip_nonlocal_bind every one can.
  bool contain(in_addr address, UdpmTime now);

 private:
  struct Range {
    uint32_t address, mask;  // as they travel
  };
  void ask(UdpmTime now);

  std::vector<Range> ranges_;
  std::optional<UdpmTime> asked_;
};

}  // namespace genio
