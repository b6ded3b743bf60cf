#pragma once
// LCM's udpm URLs.

#include <netinet/in.h>

#include <cstdint>
#include <optional>
#include <string>

namespace genio {

/// What a udpm URL names.
struct UdpmAddress {
  in_addr group{};
  uint16_t port = 0;
  int ttl = 0;             ///< 0: datagrams stay on this host
  int receive_buffer = 0;  ///< [bytes]; 0: as large as the system allows, up to 4 MiB
};

/// Of "udpm://GROUP:PORT?ttl=N&recv_buf_size=BYTES". What is left out is as in LCM: 239.255.76.67,
/// 7667 and 0; a port may be left out only with the group. Nothing for what is no such URL, or what
/// LCM would understand in another way: numbers are decimal and begin with no 0, and the group is
/// four of them. `why` says what is wrong.
std::optional<UdpmAddress> udpm_address(const std::string& url, std::string& why);

}  // namespace genio
