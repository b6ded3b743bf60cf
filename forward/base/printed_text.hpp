#pragma once
#include <fmt/format.h>

#include <iterator>
#include <string>
#include <utility>

namespace genio {

/// A text that is made piece by piece, to be written as a whole.
struct PrintedText {
  std::string text;

  template <class... T>
  void print(fmt::format_string<T...> format, T&&... values) {
    fmt::format_to(std::back_inserter(text), format, std::forward<T>(values)...);
  }
};

}  // namespace genio
