#pragma once
#include <map>
#include <string>
#include <vector>

#include "server/dispatch/dispatcher.hpp"
#include "server/workers/frame_pipe.hpp"
#include "server/workers/nursery.hpp"

namespace genio {

struct WorkerLimits {
  int count = 1;            ///< processes
  double memory_mb = 2000;  ///< of a worker, beyond what it was born with
  double silence_s = 60;    ///< without a sign of life while it works
};

/// What a worker tells of its request, or the pool of it.
struct WorkerEvent {
  enum class Kind { progress, improved, answer, lost, idle_lost } kind;
  std::string id;  ///< empty: idle_lost
  int iteration = 0;
  double rms_mm = 0;
  command_reply_t reply = {};       ///< improved, answer
  std::vector<uint8_t> state = {};  ///< answer
  std::string reason = {};  ///< lost, idle_lost: how the worker ended, as "killed by signal 9"
};

/// Worker processes of a nursery. One that crashes, hangs or outgrows its memory is replaced. For
/// one thread; nothing here waits. Times are of a steady clock [s].
class WorkerPool {
 public:
  WorkerPool(const Nursery& nursery, const WorkerLimits& limits);
  ~WorkerPool();
  WorkerPool(const WorkerPool&) = delete;
  WorkerPool& operator=(const WorkerPool&) = delete;

  /// Becomes readable when events() has something to do.
  int descriptor() const { return epoll_; }
  /// Whether start() has somebody to give work to.
  bool idle() const;
  void start(const Assignment& assignment, double now);
  /// Asks the worker of that request, if there is one, to end its work.
  void withdraw(const std::string& id);
  /// What has come since the last call; replaces who is gone or too long silent. Throws
  /// std::runtime_error where no worker can be made any more.
  std::vector<WorkerEvent> events(double now);
  int alive() const { return int(workers_.size()); }
  int64_t replaced() const { return replaced_; }

 private:
  struct Worker {
    int socket = -1;
    MessageAssembler assembler = {};
    std::vector<uint8_t> leaving = {};  ///< not sent yet
    std::string id = {};                ///< at hand; empty: idle
    double born = 0, heard = 0, watched = 0;
    double inherited_mb = 0;     ///< memory that it was born with
    std::string condemned = {};  ///< why it was killed
  };
  void send(pid_t pid, Worker& worker, const WorkerMessage& message);
  void flush(pid_t pid, Worker& worker);
  void hear(pid_t pid, Worker& worker, double now, std::vector<WorkerEvent>& events);
  void take(Worker& worker, const WorkerMessage& message, std::vector<WorkerEvent>& events);
  void meet(const NurseryEvent& event, double now, std::vector<WorkerEvent>& events);
  void watch(pid_t pid, Worker& worker, double now);
  void condemn(pid_t pid, Worker& worker, const std::string& why);
  void bear(double now);

  const Nursery& nursery_;
  const WorkerLimits limits_;
  int epoll_;
  std::map<pid_t, Worker> workers_;
  int expected_ = 0;      // asked of the nursery
  double bear_from_ = 0;  // after births that failed
  int64_t replaced_ = 0;
};

}  // namespace genio
