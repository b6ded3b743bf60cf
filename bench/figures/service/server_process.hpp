#pragma once
// A server in a process of its own, that can be killed.

#include <memory>
#include <string>
#include <vector>

#include "server/served_model.hpp"
#include "server/workers/nursery.hpp"

namespace genio::bench {

struct ServerSetup {
  std::string url = {};      ///< of a hub on this host; empty: a port that is free
  std::string journal = {};  ///< empty: none
  std::string computed =
      {};  ///< file that gets a line "TIME_US ID" for each computation that ended
  int workers = 1;
};

/// Servers one after another. Made before there is any thread; for one thread.
class ServerProcess {
 public:
  ServerProcess(std::vector<ServedModel>& models, ServerSetup setup);
  /// Ends it as SIGTERM would.
  ~ServerProcess();

  const std::string& url() const { return setup_.url; }
  /// Starts one, and waits until it is there.
  void start();
  /// As kill -9, and waits for its end.
  void kill();
  /// The worker processes of the server that is there.
  std::vector<pid_t> workers() const;
  /// The most memory that its first process, in which the hub is, has had [MB].
  double peak_mb() const;

 private:
  void wait_for(NurseryEvent::Kind kind);

  ServerSetup setup_;
  std::unique_ptr<Nursery> nursery_;
  NurseryEvent server_{};
};

}  // namespace genio::bench
