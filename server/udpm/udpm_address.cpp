#include "server/udpm/udpm_address.hpp"

#include <arpa/inet.h>
#include <fmt/format.h>

#include <charconv>
#include <string_view>

namespace genio {
namespace {

constexpr std::string_view udpm_scheme = "udpm://", usual_group = "239.255.76.67:7667";
constexpr int largest_port = 65535, largest_ttl = 255, largest_buffer = 1 << 30;

std::optional<int> number_up_to(std::string_view text, int most) {
  int number = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, number);
  const bool octal = text.size() > 1 && text.front() == '0';
  if (text.empty() || error != std::errc() || stop != end || octal) return std::nullopt;
  return number >= 0 && number <= most ? std::optional(number) : std::nullopt;
}

std::string fault_of_option(std::string_view option, UdpmAddress& address) {
  const size_t equals = std::min(option.find('='), option.size());
  const std::string_view name = option.substr(0, equals);
  const std::string_view value = option.substr(std::min(equals + 1, option.size()));
  if (name == "ttl" || name == "recv_buf_size") {
    const int most = name == "ttl" ? largest_ttl : largest_buffer;
    const auto number = number_up_to(value, most);
    if (!number) return fmt::format("{}: expected a number from 0 to {}", name, most);
    (name == "ttl" ? address.ttl : address.receive_buffer) = *number;
    return "";
  }
  return fmt::format("unknown option '{}'; expected ttl or recv_buf_size", name);
}

std::string fault_of_group(std::string_view text, UdpmAddress& address) {
  const size_t colon = text.find(':');
  const std::string host(text.substr(0, colon));
  if (host.find('\0') != host.npos || inet_pton(AF_INET, host.c_str(), &address.group) != 1 ||
      !IN_MULTICAST(ntohl(address.group.s_addr)))
    return "expected a group between 224.0.0.0 and 239.255.255.255";
  const auto port =
      colon == text.npos ? std::nullopt : number_up_to(text.substr(colon + 1), largest_port);
  if (!port || *port == 0) return fmt::format("expected a port from 1 to {}", largest_port);
  address.port = uint16_t(*port);
  return "";
}

}  // namespace

std::optional<UdpmAddress> udpm_address(const std::string& url, std::string& why) {
  std::string_view rest = url;
  why = "expected udpm://GROUP:PORT?ttl=N";
  if (!rest.starts_with(udpm_scheme)) return std::nullopt;
  rest.remove_prefix(udpm_scheme.size());
  const size_t mark = std::min(rest.find('?'), rest.size());
  const std::string_view group = rest.substr(0, mark);
  std::string_view options = rest.substr(std::min(mark + 1, rest.size()));
  UdpmAddress address;
  why = fault_of_group(group.empty() ? usual_group : group, address);
  while (why.empty() && !options.empty()) {
    const size_t end = std::min(options.find('&'), options.size());
    why = fault_of_option(options.substr(0, end), address);
    options.remove_prefix(std::min(end + 1, options.size()));
  }
  return why.empty() ? std::optional(address) : std::nullopt;
}

}  // namespace genio
