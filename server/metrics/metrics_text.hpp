#pragma once
#include <string>

#include "genio/server_status_t.hpp"
#include "server/hub/counts.hpp"
#include "server/link/counts.hpp"

namespace genio {

/// All figures of a status in Prometheus' text format 0.0.4, in UTF-8; docs/operating.md lists the
/// names. `hub`: of the server's own hub; nothing where it has none. `link`: of its connection. The
/// latency is a summary of quantiles alone, NaN before the first reply.
std::string metrics_text(const server_status_t& status, const HubCounts* hub,
                         const LinkCounts& link = {});

}  // namespace genio
