#include "server/link/link.hpp"

#include <fmt/format.h>

#include <cstdlib>
#include <new>
#include <utility>

#include "forward/base/types.hpp"
#include "server/link/tcpq_link.hpp"
#include "server/link/udpm_link.hpp"

namespace genio {
namespace {

constexpr size_t most_noted = 16;  // failures between two looks

std::unique_ptr<LinkTransport> transport_for(const std::string& url) {
  if (url.starts_with("tcpq:")) return std::make_unique<TcpqLink>(url);
  if (url.starts_with("udpm:")) return std::make_unique<UdpmLink>(url);
  throw InputError(fmt::format(
      "--lcm {}: cannot be used; expected for example {} or udpm://239.255.76.67:7667?ttl=0", url,
      default_url));
}

}  // namespace

std::string choose_url(const std::string& option) {
  if (!option.empty()) return option;
  const char* url = std::getenv("LCM_DEFAULT_URL");
  return url && *url ? url : default_url;
}

Link::Link(const std::string& url) : transport_(transport_for(url)) {}

void Link::note(Failures& failures, const std::string& channel, size_t size,
                const char* reason) noexcept {
  ++failures.count;
  try {
    if (failures.newest.size() < most_noted) failures.newest.push_back({channel, size, reason});
  } catch (const std::bad_alloc&) {
    // It is counted.
  }
}

void Link::subscribe(const std::string& channel, Handler handler) {
  transport_->subscribe(channel, [&failures = *failures_, handler = std::move(handler)](
                                     const std::string& name, const void* data, size_t size) {
    try {
      handler(name, data, size);
    } catch (const std::exception& e) {
      note(failures, name, size, e.what());
    } catch (...) {
      note(failures, name, size, "of unknown kind");
    }
  });
}

LinkCounts Link::counts() const { return {failures_->count, transport_->udpm_counts()}; }

std::vector<FailedHandling> Link::take_failures() { return std::exchange(failures_->newest, {}); }

bool Link::publish(const std::string& channel, const std::vector<uint8_t>& bytes) {
  return transport_->publish(channel, bytes);
}

bool Link::wait(int timeout_ms, std::span<const int> others) {
  return transport_->wait(timeout_ms, others);
}

bool Link::connected() const { return transport_->connected(); }

}  // namespace genio
