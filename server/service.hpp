#pragma once
// Answers shape requests over LCM.

#include <atomic>
#include <functional>
#include <string>

#include "server/dispatch/dispatcher.hpp"
#include "server/hub/counts.hpp"
#include "server/observe/observer.hpp"
#include "server/seal/seal_key.hpp"
#include "server/workers/pool.hpp"

namespace genio {

struct ServiceOptions {
  std::string url;  ///< as choose_url gives it
  SharedKey key;    ///< only who seals with it may ask; null: everyone may
  DispatchLimits limits;
  WorkerLimits workers;
  /// File that keeps requests and replies, see docs/journal.md; empty: they end with the process.
  std::string journal;
  Observer* observer = nullptr;  ///< is told what happens; outlives the call
  /// Told of each computation that ended with a reply.
  std::function<void(const std::string& id)> computed;
  /// Told the port from which the service is connected to a hub, so that its own hub may prefer it.
  std::function<void(uint16_t port)> connected_from;
  std::function<HubCounts()> hub;  ///< counts of the server's own hub, if it has one
};

/// Serves until `stop` becomes true, see Dispatcher. One thread owns the LCM connection and all
/// that is decided; it never waits for a computation, which `nursery`'s workers do, nor for the
/// disk. With a journal, a request is acknowledged and a reply sent only once they stand on the
/// disk, and what an earlier process left unanswered is taken up. Throws InputError when the URL or
/// the journal cannot be used, and std::runtime_error where no worker can be made any more.
void serve(const Nursery& nursery, const std::vector<ModelIdentity>& models,
           const ServiceOptions& options, const std::atomic<bool>& stop);

}  // namespace genio
