// The layouts by which messages are scanned are those of messages/*.lcm.

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>

#include "server/wire/wire.hpp"

namespace genio {
namespace {

struct Field {
  // count: an array's length, or the field that holds it; empty: no array
  std::string type, name, count;
};

std::vector<Field> fields_of(const std::filesystem::path& file) {
  static const std::regex pattern(R"(^\s*(\w+)\s+(\w+)\s*(?:\[\s*(\w+)\s*\])?\s*;.*)");
  std::vector<Field> fields;
  std::ifstream in(file);
  bool inside = false;
  for (std::string line; std::getline(in, line);) {
    inside |= line.starts_with("{");
    if (std::smatch m; inside && std::regex_match(line, m, pattern))
      fields.push_back({m[1], m[2], m[3]});
  }
  return fields;
}

/// As WireLayout writes it. Fails the test where it cannot: a type that it has no letter for, or an
/// array whose length is not the count before it.
std::string layout_of(const std::vector<Field>& fields) {
  const std::map<std::string, char> scalars = {{"int64_t", 'l'}, {"int32_t", 'i'}, {"int8_t", 'b'},
                                               {"byte", 'b'},    {"double", 'd'},  {"string", 's'}};
  const std::map<std::string, char> arrays = {
      {"double", 'D'}, {"int32_t", 'I'}, {"string", 'S'}, {"byte", 'B'}};
  // Bytes have a letter of their own for their count: other arrays must not be counted by it.
  const auto counts = [&](const std::string& name, bool bytes) {
    return std::any_of(fields.begin(), fields.end(), [&](const Field& f) {
      return f.count == name && (f.type == "byte") == bytes;
    });
  };
  std::string layout, last_count;
  for (const Field& f : fields) {
    const bool fixed = !f.count.empty() && std::isdigit(static_cast<unsigned char>(f.count[0]));
    const auto& letters = f.count.empty() || fixed ? scalars : arrays;
    const auto it = letters.find(f.type);
    if (it == letters.end()) {
      ADD_FAILURE() << f.name << ": a layout has no letter for " << f.type;
      continue;
    }
    if (fixed) {
      layout.append(size_t(std::stoi(f.count)), it->second);
      continue;
    }
    EXPECT_TRUE(f.count.empty() || f.count == last_count) << f.name;
    const bool n = counts(f.name, false), m = counts(f.name, true);
    EXPECT_FALSE(n && m) << f.name << " counts bytes and others";
    if (n || m) last_count = f.name;
    layout += n ? 'n' : m ? 'm' : it->second;
  }
  return layout;
}

const std::map<std::string, std::string> layouts = {
    {"shape_request_t", WireLayout<shape_request_t>::fields},
    {"command_reply_t", WireLayout<command_reply_t>::fields},
    {"progress_t", WireLayout<progress_t>::fields},
    {"cancel_t", WireLayout<cancel_t>::fields},
    {"ack_t", WireLayout<ack_t>::fields},
    {"server_status_t", WireLayout<server_status_t>::fields},
    {"part_t", WireLayout<part_t>::fields},
    {"part_ask_t", WireLayout<part_ask_t>::fields},
    {"sealed_t", WireLayout<sealed_t>::fields}};

TEST(WireLayouts, EachIsThatOfItsLcmFile) {
  size_t files = 0;
  for (const auto& file : std::filesystem::directory_iterator(GENIO_SOURCE_DIR "/messages")) {
    if (file.path().extension() != ".lcm") continue;
    ++files;
    const std::string type = file.path().stem().string();
    ASSERT_TRUE(layouts.contains(type)) << type << ".lcm has no WireLayout";
    EXPECT_EQ(layouts.at(type), layout_of(fields_of(file.path()))) << type;
  }
  EXPECT_EQ(files, layouts.size());
}

TEST(WireLayouts, AForgottenFieldShows) {
  auto fields = fields_of(GENIO_SOURCE_DIR "/messages/command_reply_t.lcm");
  ASSERT_EQ(layout_of(fields), layouts.at("command_reply_t"));
  fields.push_back({"double", "new_field", ""});
  EXPECT_NE(layout_of(fields), layouts.at("command_reply_t"));
}

}  // namespace
}  // namespace genio
