#include "forward/base/process_memory.hpp"

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <fstream>
#include <string>

namespace genio {

ProcessMemory memory_of(pid_t process) {
  size_t addresses = 0, resident = 0, shared = 0;
  std::ifstream in(fmt::format("/proc/{}/statm", process));
  if (!(in >> addresses >> resident >> shared)) return {};
  const auto page = size_t(sysconf(_SC_PAGESIZE));
  return {addresses * page, resident * page, shared * page};
}

ProcessMemory own_memory() { return memory_of(getpid()); }

size_t peak_memory_of(pid_t process) {
  std::ifstream in(fmt::format("/proc/{}/status", process));
  for (std::string word; in >> word;)
    if (size_t kib = 0; word == "VmHWM:" && in >> kib) return kib << 10;
  return 0;
}

void limit_addresses([[maybe_unused]] size_t more) {
#ifndef __SANITIZE_ADDRESS__
  const rlim_t most = own_memory().addresses + more;
  const rlimit both{most, most};
  setrlimit(RLIMIT_AS, &both);
#endif
}

}  // namespace genio
