#include "server/log/log_line.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>
#include <random>
#include <set>

namespace genio {
namespace {

using Json = nlohmann::json;

constexpr int64_t some_time = 1'709'210'096'789'012;  // [us since 1970]
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

LogEvent with_id(const std::string& id) {
  return {LogKind::refused, LogLevel::warning, {{"id", id}, {"reason", "r"}}};
}

TEST(LogLine, HasTimeLevelEventAndFields) {
  const LogEvent event{LogKind::answered,
                       LogLevel::info,
                       {{"id", "a-1"}, {"seconds", 0.12345678}, {"tries", int64_t(2)}}};
  EXPECT_EQ(log_line(event, some_time, LogForm::text),
            "2024-02-29T12:34:56.789Z info answered id=a-1 seconds=0.123457 tries=2\n");
  EXPECT_EQ(log_line(event, some_time, LogForm::json),
            R"({"time":"2024-02-29T12:34:56.789Z","level":"info","event":"answered",)"
            R"("id":"a-1","seconds":0.123457,"tries":2})"
            "\n");
}

TEST(LogLine, ATextValueCannotPassForAnotherField) {
  EXPECT_EQ(log_line(with_id("x status=converged"), some_time, LogForm::text),
            "2024-02-29T12:34:56.789Z warning refused id=\"x status=converged\" reason=r\n");
  EXPECT_EQ(log_line(with_id("a=b"), some_time, LogForm::text),
            "2024-02-29T12:34:56.789Z warning refused id=\"a=b\" reason=r\n");
  EXPECT_EQ(log_line(with_id(R"(say "x" \)"), some_time, LogForm::text),
            R"(2024-02-29T12:34:56.789Z warning refused id="say \"x\" \\" reason=r)"
            "\n");
  EXPECT_EQ(log_line(with_id(""), some_time, LogForm::text),
            "2024-02-29T12:34:56.789Z warning refused id=\"\" reason=r\n");
}

TEST(LogLine, WhatALineOrATerminalMightObeyIsEscaped) {
  const std::string id =
      "a\n2024 info answered\r\x1b[2J\x7f\t\xc2\x9b\xe2\x80\xae\xff"
      "end";
  const std::string text = log_line(with_id(id), some_time, LogForm::text);
  EXPECT_NE(text.find(R"(\x0a2024 info answered\x0d\x1b[2J\x7f\x09\xc2\x9b\xe2\x80\xae\xffend)"),
            std::string::npos)
      << text;
  const std::string json = log_line(with_id(id), some_time, LogForm::json);
  EXPECT_NE(json.find(R"(a\n2024 info answered\r\u001b[2J\u007f\t\u009b\u202e\ufffdend)"),
            std::string::npos)
      << json;
}

TEST(LogLine, AnyBytesGiveOneLineOfPrintableSigns) {
  std::mt19937 random(7);
  for (int k = 0; k < 20000; ++k) {
    std::string id(random() % 300, 0);
    for (char& c : id) c = char(random() % (k % 2 ? 256 : 128));
    const std::string text = log_line(with_id(id), some_time, LogForm::text);
    const std::string json = log_line(with_id(id), some_time, LogForm::json);
    for (const std::string* line : {&text, &json}) {
      ASSERT_EQ(line->find('\n'), line->size() - 1);
      for (size_t at = 0; at + 1 < line->size(); ++at)
        ASSERT_TRUE(uint8_t((*line)[at]) >= 0x20 && (*line)[at] != 0x7f) << *line;
    }
    const Json read = Json::parse(json);  // throws where it is none
    ASSERT_EQ(read.at("event"), "refused");
    ASSERT_EQ(read.at("reason"), "r");
    ASSERT_TRUE(text.ends_with(" reason=r\n"));
  }
}

TEST(LogLine, StringsAreCutAtTheSameLengthInBothForms) {
  const std::string longest(longest_logged, 'a');
  for (const LogForm form : {LogForm::text, LogForm::json}) {
    EXPECT_NE(log_line(with_id(longest), some_time, form).find(longest), std::string::npos);
    const std::string line = log_line(with_id(longest + "aa"), some_time, form);
    EXPECT_NE(line.find(longest + "..."), std::string::npos) << line;
    EXPECT_EQ(line.find(longest + "a"), std::string::npos) << line;
    EXPECT_LT(log_line(with_id(std::string(4 << 20, '\x01')), some_time, form).size(), 2000u);
  }
}

TEST(LogLine, WhatIsNoNumberIsNullInJson) {
  const LogEvent event{LogKind::answered, LogLevel::info, {{"rms_mm", not_a_number}}};
  EXPECT_TRUE(Json::parse(log_line(event, some_time, LogForm::json)).at("rms_mm").is_null());
  EXPECT_NE(log_line(event, some_time, LogForm::text).find("rms_mm=nan"), std::string::npos);
}

TEST(LogLine, EveryKindHasANameOfItsOwn) {
  std::set<std::string> names;
  for (int k = 0; k < int(LogKind::count); ++k) names.insert(name_of(LogKind(k)));
  EXPECT_EQ(names.size(), size_t(LogKind::count));
}

}  // namespace
}  // namespace genio
