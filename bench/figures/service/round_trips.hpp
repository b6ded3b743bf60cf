#pragma once
// What asking costs, and how it goes beside other requests.

#include "bench/figures/service/server_process.hpp"
#include "bench/problems/benchmark.hpp"

namespace genio::bench {

/// Round trips of one client beside the computation alone [ms]: `overhead_ms_median`,
/// `overhead_ms_p99`, and the resident memory of the server at a tenth of the requests and at the
/// end [MB]: `memory_mb_first`, `memory_mb_last`.
Json overheads(const std::string& url, const std::vector<shape_request_t>& questions, int count);

/// The resident memory of the server at a tenth of so many requests and at the end [MB]:
/// `memory_mb_first`, `memory_mb_last`. They end at a deadline of some milliseconds each.
Json memory_of_many(const std::string& url, const shape_request_t& question, int count);

/// Requests answered in a second, asked by several clients at once.
double throughput(const std::string& url, const std::vector<shape_request_t>& questions,
                  int clients, int each);

/// Random deadlines between 20 ms and 5 s of requests that would compute for minutes, by twenty
/// clients: `deadlines`, and the part answered by then (and 10 % or 50 ms more): `deadlines_met`,
/// and how late the latest was [ms].
Json deadlines(const std::string& url, const shape_request_t& question, int count, unsigned seed);

/// Beside a request that computes on: the longest that short ones wait for their turn, and that a
/// status takes [ms]: `short_waited_ms`, `status_ms_median`, `status_ms_p99`.
Json beside_long(const std::string& url, const shape_request_t& lasting,
                 const std::vector<shape_request_t>& questions);

}  // namespace genio::bench
