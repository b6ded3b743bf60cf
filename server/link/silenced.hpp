#pragma once
#include <mutex>

namespace genio {

/// While it lives, nothing that this process prints on standard error arrives there: around short
/// calls of a library that reports to people by itself. One at a time.
class Silenced {
 public:
  Silenced();
  ~Silenced();
  Silenced(const Silenced&) = delete;
  Silenced& operator=(const Silenced&) = delete;

 private:
  std::lock_guard<std::mutex> one_;
  int kept_;
};

}  // namespace genio
