#include "server/metrics/metrics_endpoint.hpp"

#include <utility>

#include "server/base/signals_blocked.hpp"
#include "server/metrics/metrics_loop.hpp"

namespace genio {

MetricsEndpoint::MetricsEndpoint(uint16_t port, const MetricsLimits& limits)
    : loop_(std::make_unique<MetricsLoop>(port, limits)), port_(loop_->port()) {
  const SignalsBlocked signals;
  thread_ = std::thread([this] { loop_->run(); });
}

MetricsEndpoint::~MetricsEndpoint() {
  loop_->stop();
  thread_.join();
}

void MetricsEndpoint::publish(std::string text) { loop_->publish(std::move(text)); }

}  // namespace genio
