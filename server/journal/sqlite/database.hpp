#pragma once
#include <cstdint>
#include <memory>
#include <string>

#include "server/journal/sqlite/storage_error.hpp"

struct sqlite3;

namespace genio {

/// A connection to an SQLite file, closed with its object. One thread at a time may use it. A
/// process that is forked off must neither use nor destroy it.
class Database {
 public:
  enum class Open {
    existing,   ///< to read and write, or to read where the file may not be written
    created,    ///< the same, made where there is none, for its owner alone
    immutable,  ///< to read, without looking for other programs: nobody may write
  };
  /// `path` is absolute, or ":memory:". Throws StorageError.
  Database(const std::string& path, Open how);

  /// Runs statements that take no values and whose rows are of no interest. Throws StorageError.
  void run(const std::string& sql);
  /// First value of the first row; 0 and "" without one. Throws StorageError.
  int64_t number(const char* sql) const;
  std::string text(const char* sql) const;

  bool in_transaction() const;
  /// Ends a transaction without effect, if there is one. Never throws.
  void roll_back() noexcept;
  sqlite3* handle() const { return handle_.get(); }

 private:
  struct Close {
    void operator()(sqlite3* db) const;
  };
  std::unique_ptr<sqlite3, Close> handle_;
};

/// A transaction for writing; without effect unless commit() was called.
class Transaction {
 public:
  /// Throws StorageError where another program writes for longer than the connection waits.
  explicit Transaction(Database& db) : db_(db) { db_.run("BEGIN IMMEDIATE"); }
  ~Transaction() { db_.roll_back(); }
  Transaction(const Transaction&) = delete;
  Transaction& operator=(const Transaction&) = delete;
  /// On disk when it returns. Throws StorageError.
  void commit() { db_.run("COMMIT"); }

 private:
  Database& db_;
};

}  // namespace genio
