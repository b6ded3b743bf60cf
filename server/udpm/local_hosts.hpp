#pragma once
#include <netinet/in.h>

#include <map>

#include "server/udpm/limits.hpp"

namespace genio {

/// Which addresses are this host's own. 0.0.0.0 is: so sends a host that has only its loopback
/// interface, and from elsewhere the system takes it for no group but 224.0.0.x.
class LocalHosts {
 public:
  /// The system is asked at most every ten seconds for the same address.
  bool contain(in_addr address, UdpmTime now);

 private:
  struct Known {
    bool local = false;
    UdpmTime asked{};
  };
  std::map<uint32_t, Known> known_;
};

}  // namespace genio
