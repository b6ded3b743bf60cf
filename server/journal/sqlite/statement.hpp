#pragma once
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "server/journal/sqlite/database.hpp"

struct sqlite3_stmt;

namespace genio {

/// A statement that is read once and run often. Its database must outlive it.
class Statement {
 public:
  /// One run of a statement, which ends with its object: until then it may hold a lock.
  class Run {
   public:
    ~Run();
    Run(const Run&) = delete;
    Run& operator=(const Run&) = delete;

    /// Goes to the next row; false at the end. Throws StorageError.
    bool next() const;
    /// Values of the row, columns from 0. NULL reads as 0 or nothing.
    int64_t integer(int column) const;
    std::string text(int column) const;
    std::vector<uint8_t> bytes(int column) const;

   private:
    friend class Statement;
    explicit Run(sqlite3_stmt* statement) : statement_(statement) {}
    sqlite3_stmt* statement_;
  };

  /// Throws StorageError, also where the file does not have what the statement names.
  Statement(const Database& db, const std::string& sql);

  /// Begins a run with values in the place of ?1, ?2, ... Texts are stored as the bytes that they
  /// are, not as Unicode. Throws StorageError.
  template <class... T>
  Run operator()(const T&... values) {
    int place = 0;
    (bind(++place, values), ...);
    return Run(statement_.get());
  }
  /// Runs the statement to its end.
  template <class... T>
  void run(const T&... values) {
    const auto execution = (*this)(values...);
    while (execution.next()) {
    }
  }

 private:
  void bind(int place, int64_t value);
  void bind(int place, std::span<const uint8_t> bytes);
  void bind(int place, const std::string& text);

  struct Finalize {
    void operator()(sqlite3_stmt* statement) const;
  };
  std::unique_ptr<sqlite3_stmt, Finalize> statement_;
};

}  // namespace genio
