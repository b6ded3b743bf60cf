#pragma once
#include <optional>
#include <vector>

#include "server/journal/entry.hpp"
#include "server/journal/sqlite/statement.hpp"

namespace genio {

/// The entries in a journal's file. All functions throw StorageError; those that read also where an
/// entry differs from its checksum.
class JournalTable {
 public:
  explicit JournalTable(const Database& db);

  /// Adds an accepted entry, with its request. The id must be new.
  void insert(const JournalEntry& entry);
  /// Writes state, tries, times and status of an entry that was read.
  void update(const JournalEntry& entry);
  /// The same, with its reply.
  void update_with_reply(const JournalEntry& entry);
  /// Takes an entry away with all that belongs to it. False, with no effect, where it is not
  /// answered or not there.
  bool remove(int64_t number);

  std::optional<JournalEntry> find(const std::string& id);
  /// Those that are not answered, as they were accepted.
  std::vector<JournalEntry> unanswered();
  /// Reads request and reply of an entry; false where the entry is gone. Damaged bytes are there
  /// when the error is thrown.
  bool load(JournalEntry& entry);

  /// Up to `most` entries after a number, by their numbers, also such as differ from their
  /// checksum.
  struct Read {
    JournalEntry entry;
    bool whole = false;
  };
  std::vector<Read> after(int64_t number, int most);
  /// Up to `most` entries of a state that were answered before a time, the oldest first.
  struct Candidate {
    int64_t number = 0, bytes = 0;
  };
  std::vector<Candidate> oldest(JournalState state, int64_t answered_before_us, int most);

  int64_t count(JournalState state);
  /// Bytes of the requests that are not answered.
  int64_t unanswered_bytes();

 private:
  Statement insert_, update_, find_, at_, unanswered_, after_, oldest_, count_, unanswered_bytes_;
  Statement insert_request_, insert_reply_, request_, reply_;
  Statement remove_, remove_request_, remove_reply_;
};

}  // namespace genio
