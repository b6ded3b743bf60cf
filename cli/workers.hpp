#pragma once
#include <functional>
#include <nlohmann/json.hpp>

namespace genio::cli {

/// Sends one result to whoever collects them.
using Send = std::function<void(const nlohmann::json&)>;

/// Runs work(k, send) for k = 0 to count - 1, each in a process of its own (the optimiser's linear
/// solver is not made for threads), and hands what they send to `collect` one by one, here. With
/// count 1 all happens in this process. Throws std::runtime_error where a worker died.
void in_processes(int count, const std::function<void(int, const Send&)>& work,
                  const std::function<void(const nlohmann::json&)>& collect);

}  // namespace genio::cli
