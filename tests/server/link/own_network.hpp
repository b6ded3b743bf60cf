#pragma once
#include <functional>

namespace genio::test {

/// Runs `work` in a thread that has a network of its own, in which nothing is but a loopback
/// interface that carries multicast; what the thread starts is in it, too. False, and nothing was
/// run, where this process may not make one.
enum class Routes { multicast, none };
bool in_own_network(const std::function<void()>& work, Routes routes = Routes::multicast);

}  // namespace genio::test
