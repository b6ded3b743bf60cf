#pragma once
// Reads what the reports write: SVG, HTML, CSV.

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <pugixml.hpp>
#include <sstream>
#include <string>
#include <vector>

namespace genio::test {

/// Parses XML; fails the test where it is not well formed.
inline void parse(const std::string& text, pugi::xml_document& document) {
  const auto result = document.load_string(text.c_str(), pugi::parse_default | pugi::parse_doctype);
  EXPECT_TRUE(result) << result.description() << " at " << result.offset << ": "
                      << text.substr(size_t(std::max<std::ptrdiff_t>(0, result.offset - 40)), 80);
}

/// Every text of the document, in order.
inline std::vector<std::string> texts(const pugi::xml_node& from) {
  std::vector<std::string> all;
  for (const auto& node : from.children()) {
    if (node.type() == pugi::node_pcdata) all.emplace_back(node.value());
    const auto below = texts(node);
    all.insert(all.end(), below.begin(), below.end());
  }
  return all;
}

/// How many elements `name` hold `attribute` with that value.
inline int count(const pugi::xml_node& from, const std::string& name, const std::string& attribute,
                 const std::string& value) {
  int found = 0;
  for (const auto& node : from.children()) {
    found += node.name() == name && node.attribute(attribute.c_str()).value() == value;
    found += count(node, name, attribute, value);
  }
  return found;
}

inline std::string content(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  EXPECT_TRUE(in) << path;
  return {std::istreambuf_iterator<char>(in), {}};
}

inline std::vector<std::vector<std::string>> csv(const std::string& path) {
  std::vector<std::vector<std::string>> rows;
  std::istringstream in(content(path));
  for (std::string line; std::getline(in, line);) {
    std::istringstream fields(line);
    auto& row = rows.emplace_back();
    for (std::string field; std::getline(fields, field, ',');) row.push_back(field);
  }
  return rows;
}

/// A folder that is gone after the test.
class Folder {
 public:
  Folder() {
    std::string name = (std::filesystem::temp_directory_path() / "genio-report-XXXXXX").string();
    path_ = mkdtemp(name.data());
  }
  ~Folder() { std::filesystem::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  std::string operator/(const std::string& name) const { return path_ + "/" + name; }
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

}  // namespace genio::test
