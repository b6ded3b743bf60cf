#pragma once
#include <sys/types.h>

#include <cstdint>
#include <functional>
#include <vector>

namespace genio {

/// What a nursery tells.
struct NurseryEvent {
  enum class Kind { born, not_born, ended } kind;
  pid_t pid = 0;
  int socket = -1;  ///< born: the service's end of the worker's pipe, owned by who takes it
  int status = 0;   ///< ended: as of waitpid(); not_born: errno
};

/// A process that was forked off while this one had neither threads nor a connection, and forks
/// workers whenever it is asked: with the models read, on pages that all share, and with no lock
/// held by a thread that is not there. It ends with this process, and its workers with it.
class Nursery {
 public:
  /// `work(socket)` is what a worker does; it ends when that returns. Throws std::runtime_error
  /// where the system has no process left.
  explicit Nursery(const std::function<void(int socket)>& work);
  ~Nursery();
  Nursery(const Nursery&) = delete;
  Nursery& operator=(const Nursery&) = delete;

  /// Becomes readable when there is an event.
  int descriptor() const { return socket_; }
  /// Asks for one more worker.
  void bear() const;
  /// Kills a worker if it is there still.
  void kill(pid_t worker) const;
  /// What happened since the last call. Throws std::runtime_error where the nursery has ended.
  std::vector<NurseryEvent> events() const;

 private:
  int socket_ = -1;
  pid_t pid_ = 0;
};

}  // namespace genio
