#pragma once
#include <csignal>

namespace genio {

/// While it lives, threads that are started get no signals: those are for the main thread. Writing
/// to a pipe that nobody reads is then an error of the write, and ends no process.
class SignalsBlocked {
 public:
  SignalsBlocked();
  ~SignalsBlocked();
  SignalsBlocked(const SignalsBlocked&) = delete;
  SignalsBlocked& operator=(const SignalsBlocked&) = delete;

 private:
  sigset_t before_;
};

}  // namespace genio
