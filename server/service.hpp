#pragma once
// Answers shape requests over LCM.

#include <atomic>
#include <functional>
#include <string>

#include "forward/model/model.hpp"

namespace genio {

struct ServiceOptions {
  std::string url;        ///< as choose_url gives it
  int queue = 256;        ///< requests that may wait; more are refused with a reply
  int remembered = 4096;  ///< replies kept for repeated ids
  std::function<void(const std::string& line)> log;
};

/// Serves until `stop` becomes true. One thread owns the LCM connection, one computes (Ipopt with
/// MUMPS is not thread-safe). Every request gets a reply; a repeated id gets the reply of the
/// first, computed once. Throws InputError when the URL cannot be used.
void serve(const Model& model, const ServiceOptions& options, const std::atomic<bool>& stop);

}  // namespace genio
