#include "server/journal/journal_text.hpp"

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "forward/base/types.hpp"
#include "server/journal/export_journal.hpp"
#include "server/message_json.hpp"
#include "server/wire/wire.hpp"
#include "tests/runs/temporary_folder.hpp"
#include "tests/server/journal/journal_entries.hpp"

namespace genio {
namespace {

namespace fs = std::filesystem;

JournalEntry answered_entry() {
  JournalEntry e = test::entry_of(3);
  e.id = "a\tb", e.state = JournalState::answered, e.status = "converged", e.tries = 1;
  e.number = 12, e.answered_us = 2'000'000, e.request_bytes = 6000, e.reply_bytes = 10000;
  return e;
}

TEST(JournalText, AnEntryIsALineWithAColumnForEachName) {
  const auto columns = [](const std::string& line) {
    return std::count(line.begin(), line.end(), '\t') + 1;
  };
  const std::string line = list_line(answered_entry(), "");
  EXPECT_EQ(columns(line), columns(list_header()));
  EXPECT_EQ(line,
            "12\ta\\x09b\tclient-0\tanswered\tconverged\t1970-01-01T00:00:01.000Z\t"
            "1970-01-01T00:00:02.000Z\t-\t1\t6000\t10000");
  EXPECT_NE(list_line(answered_entry(), "the reply").find("damaged: the reply"), std::string::npos);
}

TEST(JournalText, AnEntryAsJsonHasNullWhereThereIsNothing) {
  JournalEntry e = answered_entry();
  e.client = "\xff";
  const auto json = nlohmann::json::parse(entry_json(e, ""));
  EXPECT_EQ(json["id"], "a\tb");
  EXPECT_EQ(json["client"], "\xef\xbf\xbd");
  EXPECT_EQ(json["state"], "answered");
  EXPECT_EQ(json["accepted"], "1970-01-01T00:00:01.000003Z");
  EXPECT_TRUE(json["delivered"].is_null());
  EXPECT_EQ(json["digest"].get<std::string>().size(), 64u);
  EXPECT_FALSE(json.contains("damage"));
  EXPECT_EQ(nlohmann::json::parse(entry_json(e, "x"))["damage"], "x");
}

class JournalExport : public testing::Test {
 protected:
  nlohmann::json read(const std::string& name) const {
    return nlohmann::json::parse(test::content_of(out + "/" + name));
  }
  test::TemporaryFolder folder;
  const std::string path = folder.path() + "/journal", out = folder.path() + "/out/requests";
};

TEST_F(JournalExport, WritesEachMessageAsItIsOrAsHexWithANote) {
  Journal journal(path);  // its server runs on
  shape_request_t request{};
  request.id = "../a b", request.client = "c", request.point_count = 1;
  request.x_mm = {1.5}, request.y_mm = {std::nan("")}, request.z_mm = {-2}, request.sigma_mm = {0};
  request.kind = {"curve"};
  command_reply_t reply{};
  reply.id = request.id, reply.status = "converged", reply.muscle_count = 1;
  reply.muscle = {"GGP"};
  for (auto* of : {&reply.force_N, &reply.max_force_N, &reply.sd_N, &reply.low_N, &reply.high_N,
                   &reply.acts, &reply.median_N, &reply.mean_N, &reply.information_bits})
    *of = {2.5};
  JournalEntry good = test::entry_of(1), odd = test::entry_of(2, 4);
  good.id = request.id, good.request = encode(request);
  odd.request = {0, 1, 0xfe, 0xff};
  journal.accept(good), journal.accept(odd);
  journal.answered(good.id, encode(reply), "converged", 5);
  journal.sync();

  const Exported exported = export_journal(JournalView(path), out, request_json, reply_json);
  EXPECT_EQ(exported.requests, 2);
  EXPECT_EQ(exported.replies, 1);
  ASSERT_EQ(exported.notes.size(), 1u);
  EXPECT_EQ(exported.notes[0].find("00000002_request-2.request.json: "), 0u);
  const auto first = read("00000001____a_b.request.json");
  EXPECT_EQ(first["entry"]["id"], "../a b");
  EXPECT_EQ(first["message"]["x_mm"][0], 1.5);
  EXPECT_TRUE(first["message"]["y_mm"][0].is_null());
  EXPECT_EQ(read("00000001____a_b.reply.json")["message"]["force_N"][0], 2.5);
  const auto second = read("00000002_request-2.request.json");
  EXPECT_EQ(second["hex"], "0001feff");
  EXPECT_NE(second["note"].get<std::string>().find("shorter than a fingerprint"),
            std::string::npos);
  EXPECT_EQ(std::distance(fs::directory_iterator(out), fs::directory_iterator()), 3);
}

TEST_F(JournalExport, AFolderThatCannotBeMadeIsNamed) {
  Journal(path).sync();
  EXPECT_THROW(export_journal(JournalView(path), path + "/out", request_json, reply_json),
               InputError);
}

}  // namespace
}  // namespace genio
