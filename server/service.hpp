#pragma once
// Answers shape requests over LCM.

#include <atomic>
#include <functional>
#include <string>

#include "forward/model/model.hpp"
#include "server/dispatch/limits.hpp"

namespace genio {

struct ServiceOptions {
  std::string url;  ///< as choose_url gives it
  DispatchLimits limits;
  std::function<void(const std::string& line)> log;
};

/// Serves until `stop` becomes true, see Dispatcher. One thread owns the LCM connection, one
/// computes (Ipopt with MUMPS is not thread-safe). Nothing is taken before the table of starting
/// shapes is made. Throws InputError when the URL cannot be used.
void serve(const Model& model, const ServiceOptions& options, const std::atomic<bool>& stop);

}  // namespace genio
