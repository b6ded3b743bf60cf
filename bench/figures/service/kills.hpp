#pragma once
// Whether anything is lost, wrong or computed twice while processes are killed.

#include "bench/figures/service/server_process.hpp"
#include "bench/problems/benchmark.hpp"

namespace genio::bench {

struct KillPlan {
  int requests = 400, clients = 20;
  int server_kills = 10;
  double worker_kill_s = 2;  ///< between two kills of a random worker
  unsigned seed = 1;
};

/// `requests`, `replies`, `wrong` (differ from the answers of a server that was left alone),
/// `recomputed` (computed again after their reply had come), `worker_kills`, `server_kills`. The
/// server has a journal and writes the file `computed`.
Json killed_service(ServerProcess& server, const std::string& computed,
                    const std::vector<shape_request_t>& questions, const KillPlan& plan,
                    const Progress& progress);

}  // namespace genio::bench
