#include "runs/process/workers.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <vector>

#include "forward/base/types.hpp"

namespace genio {
namespace {

/// A result goes through the pipe behind the number of its bytes; so does, marked as such, the
/// reason why a worker cannot go on.
using Length = uint64_t;
constexpr Length input_mark = Length(1) << 63, failure_mark = Length(1) << 62,
                 marks = input_mark | failure_mark;

struct Worker {
  int k;
  pid_t process;
  int pipe;
  std::string pending = {};  // the beginning of a result
  Length mark = 0;           // of why it failed; 0: it did not say
  std::string reason = {};
};

void write_all(int pipe, const std::string& text) {
  for (size_t done = 0; done < text.size();) {
    const ssize_t n = write(pipe, text.data() + done, text.size() - done);
    if (n < 0) _exit(1);  // nobody collects any more
    done += size_t(n);
  }
}

void write_marked(int pipe, Length mark, const std::string& text) {
  const Length length = text.size() | mark;
  write_all(pipe, std::string(reinterpret_cast<const char*>(&length), sizeof length));
  write_all(pipe, text);
}

Worker start(int k, const std::function<void(int, const Send&)>& work) {
  int ends[2];
  if (pipe(ends) != 0) throw std::runtime_error("no pipe for a worker process");
  const pid_t process = fork();
  if (process < 0) throw std::runtime_error("no worker process can be started");
  if (process > 0) {
    close(ends[1]);
    return {k, process, ends[0]};
  }
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  close(ends[0]);
  try {
    work(k, [&](const std::string& result) { write_marked(ends[1], 0, result); });
  } catch (const InputError& e) {
    write_marked(ends[1], input_mark, e.what());
    _exit(1);
  } catch (const std::exception& e) {
    write_marked(ends[1], failure_mark, e.what());
    _exit(1);
  }
  _exit(0);
}

/// False when the worker has ended.
bool receive(Worker& worker, const Send& collect) {
  char buffer[65536];
  const ssize_t n = read(worker.pipe, buffer, sizeof buffer);
  if (n <= 0) return false;
  std::string& pending = worker.pending;
  pending.append(buffer, size_t(n));
  size_t first = 0;
  for (Length length; pending.size() - first >= sizeof length; first += sizeof length + length) {
    std::memcpy(&length, pending.data() + first, sizeof length);
    const Length mark = length & marks;
    length &= ~marks;
    if (pending.size() - first - sizeof length < length) break;
    const std::string text = pending.substr(first + sizeof length, length);
    if (mark == 0) collect(text);
    else worker.mark = mark, worker.reason = text;
  }
  pending.erase(0, first);
  return true;
}

/// Waits for a worker that has closed its pipe, and tells how it ended.
Ending ending_of(const Worker& worker) {
  close(worker.pipe);
  int status = 0;
  waitpid(worker.process, &status, 0);
  if (WIFSIGNALED(status))
    return {How::died, fmt::format("its process was killed by signal {} ({})", WTERMSIG(status),
                                   strsignal(WTERMSIG(status)))};
  if (worker.mark != 0)
    return {worker.mark == input_mark ? How::bad_input : How::failed, worker.reason};
  if (WEXITSTATUS(status) != 0)
    return {How::died, fmt::format("its process ended with status {}", WEXITSTATUS(status))};
  return {};
}

}  // namespace

void in_turn(int count, int at_once, const std::function<void(int, const Send&)>& work,
             const Send& collect, const TakeEnding& ended) {
  std::vector<Worker> workers;
  for (int next = 0; next < count || !workers.empty();) {
    while (next < count && int(workers.size()) < at_once) workers.push_back(start(next++, work));
    std::vector<pollfd> waiting;
    for (const Worker& w : workers) waiting.push_back({w.pipe, POLLIN, 0});
    if (poll(waiting.data(), waiting.size(), -1) < 0) continue;  // a signal
    for (size_t i = waiting.size(); i-- > 0;) {
      if (waiting[i].revents == 0 || receive(workers[i], collect)) continue;
      const Worker worker = std::move(workers[i]);
      workers.erase(workers.begin() + long(i));
      ended(worker.k, ending_of(worker));
    }
  }
}

void in_processes(int count, const std::function<void(int, const Send&)>& work,
                  const Send& collect) {
  if (count <= 1) return work(0, collect);
  Ending first, death;
  in_turn(count, count, work, collect, [&](int, const Ending& ending) {
    if (ending.how == How::died) death = ending;
    else if (ending.how != How::done && first.how == How::done) first = ending;
  });
  if (first.how == How::bad_input) throw InputError(first.reason);
  if (first.how == How::failed) throw std::runtime_error(first.reason);
  if (death.how == How::died)
    throw std::runtime_error("a worker process ended early; --resume takes up the rest");
}

}  // namespace genio
