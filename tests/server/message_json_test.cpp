#include "server/message_json.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <regex>

#include "server/wire/wire.hpp"

namespace genio {
namespace {

/// Names of the fields of a type, in order, as its file has them.
std::vector<std::string> fields_of_file(const std::string& type) {
  std::ifstream in(std::string(GENIO_SOURCE_DIR) + "/messages/" + type + ".lcm");
  const std::regex field(R"(^\s+\w+\s+(\w+)(\[\w+\])?;.*)");
  std::vector<std::string> names;
  std::smatch found;
  for (std::string line; std::getline(in, line);)
    if (std::regex_match(line, found, field)) names.push_back(found[1]);
  return names;
}

std::vector<std::string> keys(const std::optional<std::string>& json) {
  const auto object = nlohmann::ordered_json::parse(json.value());
  std::vector<std::string> names;
  for (const auto& item : object.items()) names.push_back(item.key());
  return names;
}

TEST(MessageJson, HasEveryFieldOfTheMessageInItsOrder) {
  std::string why;
  const auto request = fields_of_file("shape_request_t"), reply = fields_of_file("command_reply_t");
  EXPECT_GE(request.size(), 13u);
  EXPECT_GE(reply.size(), 37u);
  EXPECT_EQ(keys(request_json(encode(shape_request_t{}), why)), request);
  EXPECT_EQ(keys(reply_json(encode(command_reply_t{}), why)), reply);
}

TEST(MessageJson, BytesThatAreNoSuchMessageAreRefusedWithAReason) {
  std::string why;
  EXPECT_FALSE(request_json(encode(command_reply_t{}), why));
  EXPECT_NE(why.find("fingerprint"), std::string::npos);
  EXPECT_FALSE(reply_json({}, why));
}

TEST(MessageJson, TextsThatAreNoUnicodeAreWrittenAllTheSame) {
  shape_request_t request{};
  request.id = "\xff\n";
  std::string why;
  const auto json = request_json(encode(request), why);
  ASSERT_TRUE(json);
  EXPECT_EQ(nlohmann::json::parse(*json)["id"], "\xef\xbf\xbd\n");
}

}  // namespace
}  // namespace genio
