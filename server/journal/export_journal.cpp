#include "server/journal/export_journal.hpp"

#include <fmt/format.h>

#include <cctype>
#include <nlohmann/json.hpp>

#include "forward/base/text_file.hpp"
#include "server/base/safe_text.hpp"
#include "server/journal/journal_text.hpp"

namespace genio {
namespace {

/// What stands in the place of a message that cannot be read.
std::string hex_members(const std::vector<uint8_t>& bytes, const std::string& why) {
  std::string hex;
  hex.reserve(2 * bytes.size());
  for (const uint8_t byte : bytes) fmt::format_to(std::back_inserter(hex), "{:02x}", byte);
  const nlohmann::json note = why;
  return fmt::format(R"("note":{},"hex":"{}")",
                     note.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace), hex);
}

}  // namespace

std::string exported_json(const JournalEntry& entry, const std::vector<uint8_t>& bytes,
                          const MessageText& text, const std::string& damage) {
  std::string why = damage;
  const auto message = damage.empty() ? text(bytes, why) : std::nullopt;
  return fmt::format(R"({{"entry":{},{}}})", entry_json(entry, damage),
                     message ? R"("message":)" + *message : hex_members(bytes, why));
}

std::string export_name(const JournalEntry& entry) {
  constexpr size_t longest = 40;
  std::string id = entry.id.substr(0, longest);
  for (char& c : id)
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '-' && c != '_') c = '_';
  return fmt::format("{:08}_{}", entry.number, id);
}

Exported export_journal(const JournalView& journal, const std::string& folder,
                        const MessageText& request_text, const MessageText& reply_text) {
  make_folder(folder);
  Exported exported;
  const auto write = [&](const JournalEntry& entry, const char* part,
                         const std::vector<uint8_t>& bytes, const MessageText& text,
                         const std::string& damage) {
    const std::string name = fmt::format("{}.{}.json", export_name(entry), part);
    std::string why = damage;
    const auto noted = [&](const std::vector<uint8_t>& of, std::string& reason) {
      auto message = text(of, reason);
      why = message ? "" : reason;
      return message;
    };
    write_text(folder + "/" + name, exported_json(entry, bytes, noted, damage) + "\n");
    if (!why.empty()) exported.notes.push_back(name + ": " + escaped_text(why));
  };
  journal.each(Blobs::with, [&](const JournalEntry& entry, const std::string& damage) {
    write(entry, "request", entry.request, request_text, damage);
    ++exported.requests;
    if (entry.state == JournalState::accepted) return;
    write(entry, "reply", entry.reply, reply_text, damage);
    ++exported.replies;
  });
  return exported;
}

}  // namespace genio
