#include "inverse/recording/base/named_curve.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "inverse/recording/base/table_text.hpp"

namespace genio {
namespace {

constexpr std::array palate_words = {"palate", "palatal", "roof"};
constexpr std::array bite_words = {"bite", "occlus"};
constexpr std::array other_words = {"hyoid", "mandib", "jaw", "velum", "pharyn"};

bool holds_one_of(const std::string& text, const auto& words) {
  return std::any_of(words.begin(), words.end(),
                     [&](const char* word) { return text.find(word) != std::string::npos; });
}

/// "pal", alone or beside other words.
bool is_short_for_palate(const std::string& text) {
  for (size_t at = 0; (at = text.find("pal", at)) != std::string::npos; ++at) {
    const auto letter = [&](size_t k) {
      return k < text.size() && ((text[k] >= 'a' && text[k] <= 'z') || text[k] < 0);
    };
    if ((at == 0 || !letter(at - 1)) && !letter(at + 3)) return true;
  }
  return false;
}

std::string list_of(const std::vector<std::string>& names) {
  std::string list;
  for (size_t k = 0; k < names.size() && k < 20; ++k)
    list += (k == 0 ? "" : ", ") + in_quotes(names[k]);
  return names.size() > 20 ? list + ", ..." : list;
}

}  // namespace

bool is_called_for(const std::string& name, const std::string& role) {
  const std::string text = lower_case(name);
  const bool palate = holds_one_of(text, palate_words) || is_short_for_palate(text),
             bite = holds_one_of(text, bite_words), other = holds_one_of(text, other_words);
  if (role == "tongue")
    return text.find("tongue") != std::string::npos && !palate && !bite && !other;
  if (role == "palate") return palate && !other;
  if (role == "bite plane") return bite && !other;
  throw InputError(fmt::format("role '{}': expected tongue, palate or bite plane", role));
}

std::string named_curve(const std::vector<std::string>& names, const ReadOptions& o,
                        const std::string& where) {
  if (!o.spline.empty()) {
    for (const std::string& name : names)
      if (lower_case(name) == lower_case(o.spline)) return name;
    throw InputError(
        fmt::format("{}: has no spline {}; it has {}", where, in_quotes(o.spline), list_of(names)));
  }
  std::vector<std::string> fit;
  for (const std::string& name : names)
    if (is_called_for(name, o.role)) fit.push_back(name);
  if (fit.size() == 1) return fit.front();
  if (fit.empty() && names.size() == 1 && o.role != "tongue" &&
      !holds_one_of(lower_case(names.front()), other_words))
    return names.front();
  throw InputError(fmt::format("{}: {} named for the {}; it has {}; say which with --spline NAME",
                               where, fit.empty() ? "no spline is" : "several splines are", o.role,
                               list_of(names)));
}

}  // namespace genio
