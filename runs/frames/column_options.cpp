#include "runs/frames/column_options.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "forward/base/nearest_name.hpp"
#include "forward/base/types.hpp"

namespace genio {
namespace {

const std::vector<std::string> meanings = {"x",     "y",          "frame",     "time",
                                           "label", "likelihood", "recording", "speaker"};

}  // namespace

std::map<std::string, std::string> parsed_columns(const std::vector<std::string>& columns) {
  std::map<std::string, std::string> result;
  for (const std::string& text : columns) {
    const auto equals = text.find('=');
    if (equals == 0 || equals == std::string::npos || equals + 1 == text.size())
      throw InputError(
          fmt::format("--columns {}: expected MEANING=COLUMN, as in x=tongue_x or x=3", text));
    const std::string meaning = text.substr(0, equals);
    if (std::find(meanings.begin(), meanings.end(), meaning) == meanings.end())
      throw InputError(fmt::format("--columns {}: unknown; did you mean {}? Expected {}", text,
                                   nearest_name(meaning, meanings), fmt::join(meanings, ", ")));
    if (!result.emplace(meaning, text.substr(equals + 1)).second)
      throw InputError(fmt::format("--columns {}: {} is said twice", text, meaning));
  }
  for (const char* needed : {"x", "y"})
    if (!result.empty() && !result.contains(needed))
      throw InputError(fmt::format("--columns: which column is {}? Say {}=COLUMN", needed, needed));
  return result;
}

}  // namespace genio
