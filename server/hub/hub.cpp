#include "server/hub/hub.hpp"

#include "server/base/signals_blocked.hpp"
#include "server/hub/loop.hpp"

namespace genio {

Hub::Hub(uint16_t port, const HubLimits& limits)
    : loop_(std::make_unique<HubLoop>(port, limits)), port_(loop_->port()) {
  const SignalsBlocked signals;
  thread_ = std::thread([this] { loop_->run(); });
}

Hub::~Hub() { flush(std::chrono::milliseconds(0)); }

HubCounts Hub::counts() const { return loop_->counts(); }

void Hub::favour(uint16_t port) { loop_->favour(port); }

void Hub::flush(std::chrono::milliseconds longest) {
  if (!thread_.joinable()) return;
  loop_->finish(HubClock::now() + longest);
  thread_.join();
}

}  // namespace genio
