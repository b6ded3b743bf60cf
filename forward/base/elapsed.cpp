#include "forward/base/elapsed.hpp"

#include <sys/resource.h>

#include <chrono>

namespace genio {
namespace {

double used(int who) {
  rusage use{};
  getrusage(who, &use);
  const auto seconds = [](const timeval& t) { return double(t.tv_sec) + 1e-6 * double(t.tv_usec); };
  return seconds(use.ru_utime) + seconds(use.ru_stime);
}

}  // namespace

double processor_seconds() { return used(RUSAGE_SELF); }

double children_seconds() { return used(RUSAGE_CHILDREN); }

double Stopwatch::now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

double Stopwatch::seconds() const { return now() - started_; }

}  // namespace genio
