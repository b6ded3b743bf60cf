#pragma once
// Systemd, or whoever else starts services by its protocol (sd_notify).

#include <cstdint>
#include <optional>
#include <string>

#include "server/hub/descriptor.hpp"

namespace genio {

/// Tells the manager of services how this one is. Nothing here waits but stopping(): what the
/// manager does not take at once is told again on the next turn. For one thread.
class ServiceManager {
 public:
  /// Where nobody wants to be told.
  ServiceManager() = default;
  /// `address`: of a datagram socket, a path or, with @ in front, an abstract name. `watchdog_s`:
  /// after such a silence the manager ends the service; 0: never. Throws InputError for an address
  /// that is none.
  ServiceManager(const std::string& address, double watchdog_s);
  /// From NOTIFY_SOCKET, WATCHDOG_USEC and WATCHDOG_PID, which are taken out of the environment:
  /// no program that is started from here speaks for this one. Call it before there are threads.
  /// Throws InputError naming the variable.
  static ServiceManager from_environment();

  /// From now on requests are answered.
  void ready();
  /// The service ends on purpose. Waits up to half a second for a manager that reads slowly, since
  /// few turns follow.
  void stopping();
  /// A line for people, of what the service does.
  void say(const std::string& line);
  /// One more turn of the service's loop, which is alive. `now` [s] by a clock that never turns
  /// back.
  void turn(double now);

  double watchdog_s() const { return watchdog_s_; }

 private:
  bool send(const std::string& state, int flags) const;
  void settle();

  Descriptor socket_;
  std::string address_;
  double watchdog_s_ = 0;
  std::optional<double> last_alive_;
  std::string state_, line_;  ///< not told yet; empty: nothing
};

}  // namespace genio
