#pragma once
#include <functional>
#include <string>

namespace genio {

/// Hands over one result, any text.
using Send = std::function<void(const std::string& result)>;

/// Runs work(k, send) for k = 0 to count - 1, each in a process of its own: the optimiser's linear
/// solver is not made for threads. What they send goes to `collect` one by one, in this process.
/// With count 1 all happens here. What a worker throws is thrown here once the others are done, as
/// InputError or std::runtime_error; the latter also where a worker died.
void in_processes(int count, const std::function<void(int k, const Send&)>& work,
                  const Send& collect);

}  // namespace genio
