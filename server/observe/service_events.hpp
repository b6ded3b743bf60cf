#pragma once
// The events of a service.

#include <string>
#include <vector>

#include "genio/command_reply_t.hpp"
#include "genio/server_status_t.hpp"
#include "server/log/log_event.hpp"

namespace genio {

/// `facts`: of how it was started. `startup_s`: since the process began to load the model.
LogEvent serving_event(const server_status_t& status, std::vector<LogField> facts,
                       double startup_s);

/// What became of the requests that were there when a server was told to stop.
struct DrainCounts {
  int64_t finished = 0;    ///< they have a reply
  int64_t journalled = 0;  ///< the journal keeps them for the next server
  int64_t refused = 0;     ///< nobody keeps them, and the clients were told
};
/// From the status when it was told to stop, and the last one, where no request was taken between
/// them. `journal`: what is not answered stands in one.
DrainCounts drain_counts(const server_status_t& told, const server_status_t& last, bool journal);
LogEvent stopped_event(const server_status_t& last, const DrainCounts& drain, double drain_s);

LogEvent resumed_event(int64_t requests);
/// `refused` where nothing was computed, else `answered`; a warning where the reply is `failed`.
LogEvent reply_event(const std::string& client, const command_reply_t& reply);
/// A message of so many bytes that nobody could be told about.
LogEvent dropped_event(const std::string& channel, size_t bytes, const std::string& reason);
/// `id`: of the request that it worked on; empty: of none.
LogEvent worker_replaced_event(const std::string& id, const std::string& reason);
LogEvent journal_failed_event(const std::string& reason);

}  // namespace genio
