#pragma once
#include <stdexcept>
#include <string>

struct sqlite3;

namespace genio {

/// What SQLite could not do. what() goes on after the name of a file, such as "cannot be written:
/// No space left on device".
class StorageError : public std::runtime_error {
 public:
  enum class Kind {
    /// The file is not as SQLite or the journal left it. Unlike others, it ends no transaction.
    damaged,
    foreign,  ///< the file is no database
    busy,     ///< another program holds a lock
    unopened,
    failed,  ///< the disk is full, the file may not be written, or reading or writing it failed
  };
  StorageError(Kind kind, const std::string& what) : std::runtime_error(what), kind_(kind) {}
  /// Of a result code of SQLite, and of what the system said.
  StorageError(int code, int system_error, const std::string& message);
  Kind kind() const { return kind_; }

 private:
  Kind kind_;
};

/// Throws the StorageError of the call that ended with `code`. `db` may be null.
[[noreturn]] void throw_storage_error(int code, sqlite3* db);

}  // namespace genio
