#include "inverse/recording/textgrid.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "forward/base/input_file.hpp"
#include "forward/base/nearest_name.hpp"
#include "inverse/recording/base/table_text.hpp"
#include "inverse/recording/base/unicode.hpp"

namespace genio {
namespace {

constexpr std::uintmax_t largest_labels = std::uintmax_t(64) << 20;

/// The values of a TextGrid one after another. Praat reads free-standing numbers, texts in quotes
/// and flags in angle brackets; all else is for people, which is how long and short form differ.
class Values {
 public:
  Values(const std::string& path, std::string text) : path_(path), text_(std::move(text)) {}

  std::string text(const char* expected) {
    const Value v = next(expected);
    if (v.kind != '"')
      fail(fmt::format("expected {} in quotes, found {}", expected, in_quotes(v.text)));
    return v.text;
  }
  std::string flag(const char* expected) {
    const Value v = next(expected);
    if (v.kind != '<') fail(fmt::format("expected {}, found {}", expected, in_quotes(v.text)));
    return v.text;
  }
  double number(const char* expected) {
    const Value v = next(expected);
    double x = 0;
    if (v.kind != '0' || !parse_number(v.text, x))
      fail(fmt::format("expected {}, found {}", expected, in_quotes(v.text)));
    return x;
  }
  int count(const char* expected) {
    const double x = number(expected);
    if (x < 0 || x != std::floor(x) || x > 1e7)
      fail(fmt::format("expected {}, found {}", expected, x));
    return int(x);
  }
  [[noreturn]] void fail(const std::string& what) const {
    const auto end = text_.begin() + long(std::min(at_, text_.size()));
    throw InputError(
        fmt::format("{}:{}: {}", path_, 1 + std::count(text_.begin(), end, '\n'), what));
  }

 private:
  struct Value {
    char kind;  // '"', '<' or '0'
    std::string text;
  };

  static bool is_space(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

  Value next(const char* expected) {
    while (at_ < text_.size()) {
      if (is_space(text_[at_])) {
        ++at_;
        continue;
      }
      if (text_[at_] == '!') {  // a comment
        at_ = std::min(text_.find('\n', at_), text_.size());
        continue;
      }
      if (text_[at_] == '"') return quoted();
      size_t end = at_;
      while (end < text_.size() && !is_space(text_[end])) ++end;
      const std::string word = text_.substr(at_, end - at_);
      at_ = end;
      if (word.front() == '<' && word.back() == '>') return {'<', word};
      if (double number = 0; parse_number(word, number)) return {'0', word};
    }
    fail(fmt::format("the file ends; expected {}", expected));
  }

  Value quoted() {
    std::string result;
    for (size_t i = at_ + 1; i < text_.size(); ++i) {
      if (text_[i] != '"') result += text_[i];
      else if (i + 1 < text_.size() && text_[i + 1] == '"') result += text_[i++];
      else {
        at_ = i + 1;
        return {'"', result};
      }
    }
    fail("a text in quotes has no end");
  }

  std::string path_, text_;
  size_t at_ = 0;
};

TimedLabel interval(Values& values) {
  TimedLabel result;
  result.first_s = values.number("the start of an interval [s]");
  result.last_s = values.number("the end of an interval [s]");
  if (result.last_s < result.first_s)
    values.fail(fmt::format("an interval from {} to {} s ends before it starts", result.first_s,
                            result.last_s));
  result.label = trimmed(values.text("an interval's label"));
  return result;
}

TimedLabel point(Values& values) {
  TimedLabel result;
  result.first_s = result.last_s = values.number("the time of a point [s]");
  result.label = trimmed(values.text("a point's label"));
  return result;
}

TextGridTier tier(Values& values) {
  TextGridTier result;
  const std::string kind = values.text("the class of a tier");
  if (kind != "IntervalTier" && kind != "TextTier")
    values.fail(fmt::format("class {}: expected IntervalTier or TextTier", in_quotes(kind)));
  result.points = kind == "TextTier";
  result.name = values.text("the name of a tier");
  values.number("the start of a tier [s]"), values.number("the end of a tier [s]");
  const int size = values.count("the number of a tier's labels");
  for (int i = 0; i < size; ++i)
    result.labels.push_back(result.points ? point(values) : interval(values));
  return result;
}

std::string tier_list(const std::vector<TextGridTier>& tiers) {
  std::string list;
  for (const TextGridTier& t : tiers)
    list += fmt::format("{}{} ({} {})", list.empty() ? "" : ", ", t.name, t.labels.size(),
                        t.points ? "points" : "intervals");
  return list;
}

}  // namespace

std::vector<TextGridTier> read_textgrid(const std::string& path) {
  const std::string bytes = read_file(path, largest_labels);
  if (bytes.starts_with("ooBinaryFile"))
    throw InputError(path + ": is a binary Praat file; save it in Praat as a text file");
  std::string text = utf8_of(bytes);
  if (text.starts_with("\"Praat chronological"))
    throw InputError(path + ": is a chronological TextGrid; save it in Praat as a text file");
  Values values(path, std::move(text));
  const std::string file_type = values.text("\"ooTextFile\"");
  const std::string kind = file_type.starts_with("ooTextFile") ? values.text("\"TextGrid\"") : "";
  if (kind != "TextGrid")
    values.fail(
        "is no TextGrid of Praat, which starts with File type = \"ooTextFile\" and Object "
        "class = \"TextGrid\"");
  values.number("the start of the TextGrid [s]"), values.number("the end of the TextGrid [s]");
  if (values.flag("<exists>") != "<exists>") values.fail("the TextGrid has no tiers");
  const int size = values.count("the number of tiers");
  std::vector<TextGridTier> tiers;
  for (int i = 0; i < size; ++i) tiers.push_back(tier(values));
  if (tiers.empty()) values.fail("the TextGrid has no tiers");
  return tiers;
}

const TextGridTier& tier_named(const std::vector<TextGridTier>& tiers, const std::string& name,
                               const std::string& path) {
  if (name.empty()) {
    if (tiers.size() == 1) return tiers.front();
    throw InputError(fmt::format("--textgrid {}: say which tier with --tier; it has {}", path,
                                 tier_list(tiers)));
  }
  std::vector<std::string> names;
  const TextGridTier* found = nullptr;
  for (const TextGridTier& t : tiers) {
    if (t.name == name && found)
      throw InputError(fmt::format("--tier {}: {} has two tiers of that name", name, path));
    if (t.name == name) found = &t;
    names.push_back(t.name);
  }
  if (!found)
    throw InputError(fmt::format("--tier {}: {} has no such tier; did you mean {}? It has {}", name,
                                 path, nearest_name(name, names), tier_list(tiers)));
  return *found;
}

}  // namespace genio
