#include "server/log/log.hpp"

#include <condition_variable>
#include <deque>
#include <mutex>
#include <string>
#include <utility>

#include "forward/base/elapsed.hpp"
#include "server/base/signals_blocked.hpp"
#include "server/log/line_limit.hpp"
#include "server/log/log_output.hpp"
#include "server/wire/wire.hpp"

namespace genio {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds look_again{500};  // for seconds that are over
constexpr milliseconds out_of_memory_pause{100};

LogEvent left_out_event(const char* kind, int64_t lines, const char* reason) {
  return {
      LogKind::left_out, LogLevel::warning, {{"kind", kind}, {"lines", lines}, {"reason", reason}}};
}

}  // namespace

/// Outlives the log while its thread hangs in a write.
struct Log::Shared {
  Shared(LogForm how, int descriptor, const LogLimits& most)
      : form(how), limits(most), output(descriptor), limit(most.a_second) {}

  void run() noexcept;
  bool turn();
  void put(const LogEvent& event) {
    if (!output.write(log_line(event, now_us(), form))) ++unwritten;
  }

  const LogForm form;
  const LogLimits limits;
  const pid_t process = getpid();
  const Stopwatch clock;
  // Of the thread:
  LogOutput output;
  int64_t unwritten = 0;
  // Of all:
  std::mutex mutex;
  std::condition_variable changed;
  LineLimit limit;
  std::deque<std::string> waiting;
  size_t waiting_bytes = 0;
  int64_t overflowed = 0;
  bool ending = false, ended = false;
};

void Log::Shared::run() noexcept {
  for (bool more = true; more;) {
    try {
      more = turn();
    } catch (...) {
      std::this_thread::sleep_for(out_of_memory_pause);
    }
  }
  const std::lock_guard lock(mutex);
  ended = true;
  changed.notify_all();
}

/// Writes what waits; false once that was the last.
bool Log::Shared::turn() {
  std::unique_lock lock(mutex);
  changed.wait_for(lock, look_again, [&] { return ending || !waiting.empty(); });
  const std::deque<std::string> lines = std::exchange(waiting, {});
  waiting_bytes = 0;
  const auto left_out = limit.take_left_out(clock.seconds(), ending);
  const int64_t unread = std::exchange(overflowed, 0);
  const bool last = ending;
  lock.unlock();
  for (const std::string& line : lines)
    if (!output.write(line)) ++unwritten;
  for (const auto& [kind, count] : left_out)
    put(left_out_event(name_of(kind), count, "too many in a second"));
  if (unread > 0) put(left_out_event("any", unread, "they were not read in time"));
  if (unwritten > 0) {
    const int64_t before = std::exchange(unwritten, 0);
    put(left_out_event("any", before, "they could not be written"));
    if (unwritten > 0) unwritten = before;
  }
  return !last;
}

Log::Log(LogForm form, int descriptor, const LogLimits& limits)
    : shared_(std::make_shared<Shared>(form, descriptor, limits)) {
  const SignalsBlocked signals;
  writer_ = std::thread([shared = shared_] { shared->run(); });
}

Log::~Log() {
  if (getpid() != shared_->process) {  // the thread is not here
    writer_.detach();
    return;
  }
  std::unique_lock lock(shared_->mutex);
  shared_->ending = true;
  shared_->changed.notify_all();
  const bool ended =
      shared_->changed.wait_for(lock, shared_->limits.last, [&] { return shared_->ended; });
  lock.unlock();
  if (ended) writer_.join();
  else writer_.detach();
}

void Log::write(const LogEvent& event) noexcept {
  Shared& s = *shared_;
  if (getpid() != s.process) return;  // the lock may be held for ever there
  try {
    {
      const std::lock_guard lock(s.mutex);
      if (!s.limit.passes(event.kind, s.clock.seconds())) return;
    }
    std::string line = log_line(event, now_us(), s.form);
    const std::lock_guard lock(s.mutex);
    if (s.waiting.size() >= s.limits.waiting ||
        s.waiting_bytes + line.size() > s.limits.waiting_bytes) {
      ++s.overflowed;
      return;
    }
    s.waiting_bytes += line.size();
    s.waiting.push_back(std::move(line));
    s.changed.notify_all();
  } catch (...) {  // NOLINT(bugprone-empty-catch): without memory for a line there is no line
  }
}

}  // namespace genio
