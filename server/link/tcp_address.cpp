#include "server/link/tcp_address.hpp"

#include <arpa/inet.h>
#include <netdb.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <algorithm>
#include <charconv>
#include <memory>
#include <string_view>

namespace genio {
namespace {

constexpr std::string_view this_host = "127.0.0.1";
constexpr uint16_t usual_port = 7700;
constexpr size_t longest_host = 253;  // of a name in the DNS

bool may_be_a_host(std::string_view text) {
  return text.size() <= longest_host && std::all_of(text.begin(), text.end(), [](char c) {
           return c > ' ' && c < 127 && c != ':' && c != '/' && c != '?';
         });
}

std::optional<uint16_t> port_of(std::string_view text) {
  uint16_t port = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, port);
  if (error != std::errc() || stop != end || text.front() == '0') return std::nullopt;
  return port;
}

/// Also 0.0.0.0, from which connecting leads to this host.
bool leads_here(in_addr address) {
  const uint32_t bits = ntohl(address.s_addr);
  return bits >> 24 == IN_LOOPBACKNET || bits == INADDR_ANY;
}

}  // namespace

std::optional<TcpAddress> tcp_address(const std::string& url) {
  std::string_view rest = url;
  constexpr std::string_view scheme = "tcpq://";
  if (!rest.starts_with(scheme)) return std::nullopt;
  rest.remove_prefix(scheme.size());
  rest = rest.substr(0, rest.find('?'));
  if (rest.ends_with('/')) rest.remove_suffix(1);
  const size_t colon = rest.find(':');
  const std::string_view host = rest.substr(0, colon);
  const auto port = colon == rest.npos ? usual_port : port_of(rest.substr(colon + 1));
  if (!port || !may_be_a_host(host)) return std::nullopt;
  return TcpAddress{std::string(host.empty() ? this_host : host), *port};
}

std::optional<std::string> numeric_host(const std::string& host) {
  addrinfo wanted{}, *found = nullptr;
  wanted.ai_family = AF_INET;  // as LCM
  wanted.ai_socktype = SOCK_STREAM;
  if (getaddrinfo(host.c_str(), nullptr, &wanted, &found) != 0 || !found) return std::nullopt;
  const std::unique_ptr<addrinfo, decltype(&freeaddrinfo)> owner(found, freeaddrinfo);
  const in_addr address = reinterpret_cast<const sockaddr_in*>(found->ai_addr)->sin_addr;
  if (leads_here(address)) return std::string(this_host);
  char text[INET_ADDRSTRLEN] = "";
  inet_ntop(AF_INET, &address, text, sizeof text);
  return text;
}

uint16_t local_tcpq_port(const std::string& url) {
  const auto address = tcp_address(url);
  if (!address || numeric_host(address->host) != this_host) return 0;
  return address->port;
}

}  // namespace genio
