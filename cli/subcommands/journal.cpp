#include "cli/subcommands/journal.hpp"

#include <fmt/format.h>

#include <cmath>
#include <memory>

#include "cli/support.hpp"
#include "forward/base/types.hpp"
#include "server/journal/export_journal.hpp"
#include "server/journal/journal_text.hpp"
#include "server/journal/journal_view.hpp"
#include "server/journal/prune_journal.hpp"
#include "server/message_json.hpp"
#include "server/wire/wire.hpp"

namespace genio::cli {
namespace {

struct JournalCommand {
  std::string file, out;
  std::optional<double> older_than_days, keep_mb;
  bool delivered = false, json = false;
};

int run_list(const JournalCommand& o) {
  const JournalView journal(o.file);
  if (!o.json) fmt::print("{}\n", list_header());
  journal.each(Blobs::without, [&](const JournalEntry& entry, const std::string& damage) {
    fmt::print("{}\n", o.json ? entry_json(entry, damage) : list_line(entry, damage));
  });
  if (!o.json) print_line(counts_line(journal.counts()));
  return done;
}

int run_export(const JournalCommand& o) {
  if (o.out.empty()) throw InputError("journal export: expected --out DIR");
  const Exported exported = export_journal(JournalView(o.file), o.out, request_json, reply_json);
  for (const std::string& note : exported.notes) print_line("written as hex: " + note);
  if (o.json)
    fmt::print(R"({{"requests":{},"replies":{},"as_hex":{}}})"
               "\n",
               exported.requests, exported.replies, exported.notes.size());
  else
    print_line(
        fmt::format("{}: {} requests, {} replies", o.out, exported.requests, exported.replies));
  return done;
}

/// What the options say, at a time [us since 1970].
PruneRule rule_of(const JournalCommand& o, int64_t now) {
  constexpr double day_us = 86'400e6, longest_days = 1e5;
  if (!o.older_than_days && !o.keep_mb && !o.delivered)
    throw InputError("journal prune: expected --older-than, --keep-mb or --delivered");
  PruneRule rule;
  rule.delivered_only = o.delivered;
  if (o.older_than_days) {
    const double days = std::min(*o.older_than_days, longest_days);
    rule.delivered_before_us = rule.answered_before_us = now - std::llround(days * day_us);
  } else if (o.delivered && !o.keep_mb) {
    rule.delivered_before_us = std::numeric_limits<int64_t>::max();
  }
  if (o.keep_mb) rule.keep_bytes = std::llround(std::min(1e6 * *o.keep_mb, 1e18));
  return rule;
}

int run_prune(const JournalCommand& o) {
  const Pruned pruned = prune_journal(o.file, rule_of(o, now_us()));
  const JournalCounts left = JournalView(o.file).counts();
  fmt::print("{}\n", o.json ? pruned_json(pruned, left) : pruned_line(pruned, left));
  return done;
}

}  // namespace

Runner add_journal(Options& options) {
  auto o = std::make_shared<JournalCommand>();
  options.add("file", o->file, "The file of genio serve --journal, which may run meanwhile",
              {.required = true});
  options.flag("--json", o->json, "JSON on standard output: of list an object an entry");
  options.add("--out", o->out, "Folder for the files of export");
  options.add("--older-than", o->older_than_days, "Days after which an answer is pruned",
              {.positive = true});
  options.add("--keep-mb", o->keep_mb,
              "Size to prune to: the oldest delivered answers go first, then the oldest others",
              {.positive = true});
  options.flag("--delivered", o->delivered,
               "Prune only what the client acknowledged, all of it without other options");
  // Before the commands, whose help ends with it too.
  options.footer(
      "Examples: genio journal requests.journal list\n"
      "          genio journal requests.journal export --out requests\n"
      "          genio journal requests.journal prune --older-than 30");
  const Options list = options.subcommand("list", "A line a request: its state, times and sizes",
                                          {"file", "--json"});
  const Options write = options.subcommand(
      "export", "Each request and reply as a JSON file in --out", {"file", "--json", "--out"});
  const Options prune =
      options.subcommand("prune", "Take answered requests away; never such as wait for an answer",
                         {"file", "--json", "--older-than", "--keep-mb", "--delivered"});
  return [=]() -> int {
    if (list.chosen() + write.chosen() + prune.chosen() != 1)
      throw InputError("journal: expected one of list, export and prune after the file");
    return list.chosen() ? run_list(*o) : write.chosen() ? run_export(*o) : run_prune(*o);
  };
}

}  // namespace genio::cli
