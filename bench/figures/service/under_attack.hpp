#pragma once
#include "bench/figures/service/server_process.hpp"
#include "bench/problems/benchmark.hpp"

namespace genio::bench {

/// For each attack, for so long: `status_ms_median`, `status_ms_p99` and `status_ms_worst` of an
/// honest client that asks every 10 ms (10 s where no answer came), `unanswered` of its `asked`,
/// how long an honest request of another client took (`request_s`), and what the attackers sent
/// [MB]. `memory_mb` is the most that the server's process took until then.
Json under_attack(const ServerProcess& server, const shape_request_t& question, double seconds_each,
                  const Progress& progress);

}  // namespace genio::bench
