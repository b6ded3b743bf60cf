#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "server/journal/journal_view.hpp"

namespace genio {

/// The JSON of a message's bytes; nothing, with `why`, where they are no such message.
using MessageText =
    std::function<std::optional<std::string>(const std::vector<uint8_t>& bytes, std::string& why)>;

/// A file of an export: {"entry":{...},"message":{...}}, or "hex" and "note" in the place of the
/// message where it cannot be read or is damaged.
std::string exported_json(const JournalEntry& entry, const std::vector<uint8_t>& bytes,
                          const MessageText& text, const std::string& damage);

/// NUMBER_ID without an ending; of the id what is harmless in the name of a file, cut to 40.
std::string export_name(const JournalEntry& entry);

struct Exported {
  int requests = 0, replies = 0;
  std::vector<std::string> notes;  ///< on those that were written as hex, a line each
};

/// Writes NUMBER_ID.request.json of every entry, and NUMBER_ID.reply.json where there is a reply,
/// into a folder that is made where it is missing. Throws InputError naming the file.
Exported export_journal(const JournalView& journal, const std::string& folder,
                        const MessageText& request_text, const MessageText& reply_text);

}  // namespace genio
