#include "server/observe/service_manager.hpp"

#include <fmt/format.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <sys/un.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <stdexcept>

#include "forward/base/types.hpp"
#include "server/base/safe_text.hpp"

namespace genio {
namespace {

constexpr timeval longest_goodbye{0, 500000};

/// The variable's value, which no child inherits; empty where it is not set.
std::string take_variable(const char* name) {
  const char* const value = std::getenv(name);
  std::string taken = value ? value : "";
  unsetenv(name);
  return taken;
}

int64_t positive_number(const char* name, const std::string& text) {
  int64_t value = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || stop != end || value <= 0)
    throw InputError(fmt::format("{}={}: expected a positive number", name, escaped_text(text)));
  return value;
}

}  // namespace

ServiceManager::ServiceManager(const std::string& address, double watchdog_s)
    : address_(address), watchdog_s_(watchdog_s) {
  const bool named = address.size() > 1 && (address[0] == '/' || address[0] == '@');
  if (!named || address.size() >= sizeof sockaddr_un::sun_path)
    throw InputError(
        fmt::format("NOTIFY_SOCKET={}: expected a path, or @ and a name, of at most {} bytes",
                    escaped_text(address), sizeof sockaddr_un::sun_path - 1));
  socket_.reset(::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0));
  if (!socket_)
    throw std::runtime_error(
        fmt::format("NOTIFY_SOCKET={}: {}", escaped_text(address), std::strerror(errno)));
  setsockopt(socket_.get(), SOL_SOCKET, SO_SNDTIMEO, &longest_goodbye, sizeof longest_goodbye);
}

ServiceManager ServiceManager::from_environment() {
  const std::string address = take_variable("NOTIFY_SOCKET");
  const std::string period = take_variable("WATCHDOG_USEC"),
                    process = take_variable("WATCHDOG_PID");
  if (address.empty()) return {};
  double watchdog_s = 0;
  if (!period.empty() && (process.empty() || positive_number("WATCHDOG_PID", process) == getpid()))
    watchdog_s = 1e-6 * double(positive_number("WATCHDOG_USEC", period));
  return ServiceManager(address, watchdog_s);
}

bool ServiceManager::send(const std::string& state, int flags) const {
  sockaddr_un to{};
  to.sun_family = AF_UNIX;
  std::memcpy(to.sun_path, address_.data(), address_.size());
  if (to.sun_path[0] == '@') to.sun_path[0] = 0;  // an abstract name has no end but its length
  const auto length = socklen_t(offsetof(sockaddr_un, sun_path) + address_.size());
  return sendto(socket_.get(), state.data(), state.size(), flags | MSG_NOSIGNAL,
                reinterpret_cast<const sockaddr*>(&to), length) == ssize_t(state.size());
}

void ServiceManager::settle() {
  if (!state_.empty() && send(state_, MSG_DONTWAIT)) state_.clear();
  if (state_.empty() && !line_.empty() && send("STATUS=" + line_, MSG_DONTWAIT)) line_.clear();
}

void ServiceManager::ready() {
  if (!socket_) return;
  state_ = "READY=1";
  settle();
}

void ServiceManager::stopping() {
  if (!socket_) return;
  if (send("STOPPING=1", 0)) state_.clear();
  else state_ = "STOPPING=1";
}

void ServiceManager::say(const std::string& line) {
  if (!socket_) return;
  line_ = escaped_text(line);
  settle();
}

void ServiceManager::turn(double now) {
  if (!socket_) return;
  settle();
  if (watchdog_s_ <= 0 || (last_alive_ && now - *last_alive_ < 0.5 * watchdog_s_)) return;
  if (send("WATCHDOG=1", MSG_DONTWAIT)) last_alive_ = now;
}

}  // namespace genio
