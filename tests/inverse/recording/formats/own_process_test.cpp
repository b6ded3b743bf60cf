// What happens to a process that reads a file stays in it, and is told as the file's fault.

#include "inverse/recording/binary/own_process.hpp"

#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>
#include <vector>

#include "inverse/recording/base/table_text.hpp"
#include "inverse/recording/binary/data_tree.hpp"

namespace genio {
namespace {

std::string reason(const std::function<std::string()>& work) {
  try {
    in_own_process("a.mat", work);
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

TEST(OwnProcess, WhatItGivesComesBackWhole) {
  const std::string long_one(3'000'000, 'x');
  EXPECT_EQ(in_own_process("a", [&] { return long_one; }), long_one);
  EXPECT_EQ(in_own_process("a", [] { return std::string("\0.", 2); }), std::string("\0.", 2));
  EXPECT_EQ(in_own_process("a", [] { return std::string(); }), "");
}

TEST(OwnProcess, ACrashIsTheFilesFault) {
  for (const int deadly : {SIGSEGV, SIGABRT, SIGBUS})
    EXPECT_EQ(reason([&]() -> std::string {
                std::raise(deadly);
                return "";
              }).find("a.mat: is broken"),
              0u);
  EXPECT_NE(reason([]() -> std::string { std::_Exit(0); }).find("a.mat: is broken"),
            std::string::npos);
  EXPECT_NE(reason([]() -> std::string {
              std::raise(SIGXCPU);
              return "";
            }).find("too long"),
            std::string::npos);
}

TEST(OwnProcess, ErrorsOfTheWorkGoThrough) {
  EXPECT_EQ(reason([]() -> std::string { throw InputError("a.mat:3: no x"); }), "a.mat:3: no x");
  EXPECT_EQ(reason([]() -> std::string { throw std::runtime_error("odd"); }),
            "a.mat: cannot be read: odd");
  EXPECT_NE(reason([]() -> std::string { throw std::bad_alloc(); }).find("more memory"),
            std::string::npos);
}

TEST(DataTree, PackedOnesComeBackAndBrokenOnesAreRefused) {
  DataTree tree;
  tree.kind = DataTree::Kind::record;
  DataTree& child = tree.children.emplace_back();
  child.kind = DataTree::Kind::numbers;
  child.name = "SIGNAL", child.rows = 2, child.columns = 3, child.numbers = {1, 2, 3, 4, 5, 6};
  const std::string bytes = packed(tree);
  const DataTree back = unpacked(bytes);
  ASSERT_NE(back.find("signal"), nullptr);
  EXPECT_EQ(back.find("signal")->numbers, child.numbers);
  for (size_t k = 0; k < bytes.size(); ++k) EXPECT_THROW(unpacked(bytes.substr(0, k)), InputError);
  EXPECT_THROW(unpacked(bytes + "x"), InputError);
  for (size_t k = 0; k < bytes.size(); ++k) {
    std::string broken = bytes;
    broken[k] = '\x7f';
    try {
      unpacked(broken);
    } catch (const InputError&) {
      continue;
    }
  }
}

}  // namespace
}  // namespace genio
