#pragma once
// LCM's tcpq URLs.

#include <cstdint>
#include <optional>
#include <string>

namespace genio {

/// What a tcpq URL names.
struct TcpAddress {
  std::string host;  ///< as it was written; this host where it was left out
  uint16_t port = 0;
};

/// Of "tcpq://HOST:PORT", both of which may be left out; options after a question mark are ignored,
/// as LCM ignores them. Nothing for what is no such URL. A port is decimal and begins with no 0,
/// since LCM would read 07700 as octal.
std::optional<TcpAddress> tcp_address(const std::string& url);

/// The IPv4 address of a host in the usual notation, by all spellings and names that the system
/// understands. Everything that leads to this host alone becomes 127.0.0.1, where the hub listens:
/// 127.x.y.z, 0.0.0.0 and names for these. Nothing where the host is not known (now).
std::optional<std::string> numeric_host(const std::string& host);

/// Port of a tcpq URL that leads to this host alone; 0 for any other URL.
uint16_t local_tcpq_port(const std::string& url);

}  // namespace genio
