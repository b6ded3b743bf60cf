#pragma once
#include <optional>
#include <string>

#include "server/journal/sqlite/database.hpp"

namespace genio {

/// One owner at a time of a file, for the life of the object, through a lock on the empty file
/// PATH.lock, which stays there. The lock ends with the process, however that ends, and processes
/// that are forked off do not inherit it. With flock they would: the workers of a server that was
/// killed would keep its journal from the next one.
class FileLock {
 public:
  /// Nothing is locked for ":memory:". Throws StorageError, which names the lock file where that
  /// cannot be made.
  explicit FileLock(const std::string& path);

 private:
  std::optional<Database> lock_;
};

}  // namespace genio
