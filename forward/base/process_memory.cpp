#include "forward/base/process_memory.hpp"

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <fstream>

namespace genio {

ProcessMemory memory_of(pid_t process) {
  size_t addresses = 0, resident = 0, shared = 0;
  std::ifstream in(fmt::format("/proc/{}/statm", process));
  if (!(in >> addresses >> resident >> shared)) return {};
  const auto page = size_t(sysconf(_SC_PAGESIZE));
  return {addresses * page, resident * page, shared * page};
}

ProcessMemory own_memory() { return memory_of(getpid()); }

void limit_addresses([[maybe_unused]] size_t more) {
#ifndef __SANITIZE_ADDRESS__
  const rlim_t most = own_memory().addresses + more;
  const rlimit both{most, most};
  setrlimit(RLIMIT_AS, &both);
#endif
}

}  // namespace genio
