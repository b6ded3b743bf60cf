#pragma once
// Answers shape requests over LCM.

#include <atomic>
#include <functional>
#include <string>

#include "forward/model/model.hpp"
#include "server/dispatch/limits.hpp"
#include "server/seal/seal_key.hpp"

namespace genio {

struct ServiceOptions {
  std::string url;  ///< as choose_url gives it
  SharedKey key;    ///< only who seals with it may ask; null: everyone may
  DispatchLimits limits;
  /// File that keeps requests and replies, see docs/journal.md; empty: they end with the process.
  std::string journal;
  std::function<void(const std::string& line)> log;
};

/// Serves until `stop` becomes true, see Dispatcher. One thread owns the LCM connection, one
/// computes (Ipopt with MUMPS is not thread-safe). Nothing is taken before the table of starting
/// shapes is made. With a journal, a request is acknowledged and a reply sent only once they stand
/// on the disk, and what an earlier process left unanswered is taken up. Throws InputError when the
/// URL or the journal cannot be used.
void serve(const Model& model, const ServiceOptions& options, const std::atomic<bool>& stop);

}  // namespace genio
