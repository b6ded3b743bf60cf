#pragma once
#include <sys/types.h>

#include <cstddef>

namespace genio {

/// Memory of a process as the system counts it [bytes].
struct ProcessMemory {
  size_t addresses = 0;  ///< of its whole address space
  size_t resident = 0;   ///< in memory
  size_t shared = 0;     ///< of that, from files
};

/// All 0 where the process is gone.
ProcessMemory memory_of(pid_t process);
ProcessMemory own_memory();

/// The most that a process has had in memory so far [bytes]; 0 where it is gone.
size_t peak_memory_of(pid_t process);

/// Bounds the addresses of this process to what it has now and so many bytes more. Does nothing
/// with the address sanitizer, which keeps terabytes of them to itself.
void limit_addresses(size_t more);

}  // namespace genio
