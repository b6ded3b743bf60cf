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

/// How the work of a process ended: to its end; with an InputError, or another exception; or the
/// process itself died. `reason` says why, in words.
enum class How { done, bad_input, failed, died };
struct Ending {
  How how = How::done;
  std::string reason = {};
};
using TakeEnding = std::function<void(int k, const Ending&)>;

/// The same, never more than `at_once` at a time and each in a process of its own, also a single
/// one. `ended` hears in this process how each ended; nothing is thrown for it.
void in_turn(int count, int at_once, const std::function<void(int k, const Send&)>& work,
             const Send& collect, const TakeEnding& ended);

}  // namespace genio
